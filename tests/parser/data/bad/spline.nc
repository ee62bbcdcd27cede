; [not-simulated] 2:1: error: G6.2 is not simulated (hint: write splines as short G1 blocks)
G6.2 P4 X1 Y1
