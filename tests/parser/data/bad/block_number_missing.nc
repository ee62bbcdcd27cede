; [value-missing] 2:2: error: N has no number (hint: write N and 1 to 8 digits, or leave it away)
N-1 G0 X5
