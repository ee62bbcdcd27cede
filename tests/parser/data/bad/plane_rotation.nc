; [word-missing] 2:1: error: G68 without an angle (hint: give R in degrees)
G68 X0 Y0
