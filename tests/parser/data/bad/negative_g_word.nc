; [unknown-word] 2:1: error: unknown word G-1 (hint: near it are G0 G1 G2 G3 G4)
G-1 X0
