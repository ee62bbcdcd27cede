; 2:1: error: G53 without G0 or G1 (hint: write G53 G0 or G53 G1)
G53 X0
