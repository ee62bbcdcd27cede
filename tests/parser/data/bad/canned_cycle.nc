; 2:1: error: G81 is not simulated (hint: write the cycle out as G0 and G1 blocks)
G81 X1 Y1 Z-5 R2 F100
