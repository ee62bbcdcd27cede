; [out-of-range] 3:13: error: P0 is out of range (hint: P goes from 1 to 10000)
G0 X0 Y0
G2 X0 Y0 I5 P0 F100
