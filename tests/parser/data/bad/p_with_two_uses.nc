; [word-ambiguous] 2:5: error: P2000 could belong to two words of the block (hint: write two blocks)
M98 P2000 G4
