; [word-twice] 2:4: error: G0 and G1 contradict each other in a block (hint: leave one of them out, or write two blocks)
G0 G1 X5
