; [word-unused] 2:7: error: H1 has no meaning in this block (hint: H belongs to G43, G43.4 and G43.5)
G0 X5 H1
