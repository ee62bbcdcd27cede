; [word-twice] 2:5: error: G43 and G49 contradict each other in a block (hint: leave one of them out, or write two blocks)
G43 G49 H1
