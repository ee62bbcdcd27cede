; [word-unused] 5:7: error: K1 has no meaning in this block (hint: I J K give the centre of G2 and G3 along the axes of the plane (G17 I J, G18 I K, G19 J K), and the tool vector of G0 and G1 after G43.5)
G43.5 H1
G0 X0 K1
G49
G0 X5 K1
