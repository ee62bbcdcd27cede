; [function-domain] 2:5: error: LN of 0 (hint: its argument must be positive)
G0 XLN[0]
