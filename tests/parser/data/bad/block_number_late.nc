; [word-order] 2:4: error: N is not the first word (hint: put the block number at the start of the block)
G0 N10 X5
