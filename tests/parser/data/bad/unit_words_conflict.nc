; [word-twice] 2:5: error: G20 and G21 contradict each other in a block (hint: leave one of them out, or write two blocks)
G20 G21
