; [arc-radius] 3:8: error: R 4 mm is too small: the end is 10 mm from the start (hint: R must be at least 5 mm; correct R or the end)
G0 X0 Y0
G2 X10 R4 F100
