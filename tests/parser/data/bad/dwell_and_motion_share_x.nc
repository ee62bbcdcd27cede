; [word-ambiguous] 2:7: error: X2 could belong to two words of the block (hint: write two blocks)
G1 G4 X2 F100
