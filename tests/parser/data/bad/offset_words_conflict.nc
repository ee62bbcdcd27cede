; [word-twice] 2:5: error: G54 and G55 contradict each other in a block (hint: leave one of them out, or write two blocks)
G54 G55
