; [word-twice] 2:9: error: M3 and M4 contradict each other in a block (hint: leave one of them out, or write two blocks)
S100 M3 M4
