; [word-unused] 2:7: error: R1 has no meaning in this block (hint: R belongs to G2, G3 and G10)
G0 X5 R1
