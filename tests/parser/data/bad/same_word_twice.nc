; [word-twice] 2:12: error: G1 is given twice in a block (hint: leave one of them out, or write two blocks)
G1 X5 F100 G1
