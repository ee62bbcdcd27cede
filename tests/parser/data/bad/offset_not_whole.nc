; [not-whole] 2:5: error: H1.5 is not a whole number (hint: give H without decimals)
G43 H1.5
