; [word-twice] 2:5: error: G90 and G91 contradict each other in a block (hint: leave one of them out, or write two blocks)
G90 G91 X5
