; [radius-compensation] 2:5: error: the tool table has no tool 1 (hint: give the tool's diameter in the tool table)
G41 D1
