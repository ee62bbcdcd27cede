; [word-unused] 3:1: error: X5 has no meaning in this block (hint: axis words need a motion word (G0, G1, G2, G3) or G28)
G80
X5
