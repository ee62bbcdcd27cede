; [not-whole] 2:1: error: T1.25 is not a whole number (hint: give T without decimals)
T1.25
