; [word-unused] 2:7: error: P3 has no meaning in this block (hint: P belongs to G4, G2, G3, M98, G10, G30, G54.1, G5.1, G8 and G64)
G0 X5 P3
