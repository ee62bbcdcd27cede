; 2:1: error: G5 is not simulated (hint: write splines as short G1 blocks)
G5 X1 I1 J1 P1 Q1
