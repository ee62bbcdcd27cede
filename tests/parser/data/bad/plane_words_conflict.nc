; [word-twice] 2:5: error: G17 and G18 contradict each other in a block (hint: leave one of them out, or write two blocks)
G17 G18
