; [word-twice] 2:4: error: M0 and M30 contradict each other in a block (hint: leave one of them out, or write two blocks)
M0 M30
