; [word-twice] 2:5: error: G93 and G94 contradict each other in a block (hint: leave one of them out, or write two blocks)
G93 G94
