; [word-twice] 2:4: error: M8 and M9 contradict each other in a block (hint: leave one of them out, or write two blocks)
M8 M9
