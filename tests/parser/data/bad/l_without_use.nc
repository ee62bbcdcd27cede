; [word-unused] 2:7: error: L3 has no meaning in this block (hint: L belongs to G10 and M98)
G0 X5 L3
