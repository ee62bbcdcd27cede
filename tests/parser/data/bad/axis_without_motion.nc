; [word-unused] 2:5: error: X5 has no meaning in this block (hint: axis words need a motion word (G0, G1, G2, G3) or G28)
G90 X5
