; [value-missing] 2:3: error: N has no number (hint: write N and 1 to 8 digits, or leave it away)
N G0 X5
