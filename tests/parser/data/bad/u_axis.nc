; [word-unused] 2:4: error: U5 has no meaning in this block (hint: U belongs to G4)
G0 U5
