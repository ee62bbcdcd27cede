; [word-twice] 2:7: error: X is given twice in a block (hint: leave one of them out, or write two blocks)
G0 X5 X6
