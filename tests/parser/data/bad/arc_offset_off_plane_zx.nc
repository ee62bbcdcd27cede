; [word-unused] 3:11: error: J1 has no meaning in this block (hint: I J K give the centre of G2 and G3 along the axes of the plane (G17 I J, G18 I K, G19 J K), and the tool vector of G0 and G1 after G43.5)
G18 G0 X0 Z0
G2 X10 I5 J1 F100
