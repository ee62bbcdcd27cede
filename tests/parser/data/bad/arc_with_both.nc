; [arc-centre-twice] 3:11: error: G2 has both R and a centre (hint: give R, or I and J)
G0 X0 Y0
G2 X10 I5 R5 F100
