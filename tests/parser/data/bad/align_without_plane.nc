; [plane-missing] 2:1: error: no tilted plane to align the tool with (hint: define it before, by G68.2)
G53.1
