; [word-unused] 3:7: error: Y1 has no meaning in this block (hint: axis words need a motion word (G0, G1, G2, G3) or G28)
G0 X0
G4 P5 Y1
