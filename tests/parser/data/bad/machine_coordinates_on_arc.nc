; 3:1: error: G53 without G0 or G1 (hint: write G53 G0 or G53 G1)
G0 X0 Y0
G53 G2 X0 F1
