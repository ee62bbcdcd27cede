; [unknown-word] 2:1: error: unknown word G54.05 (hint: near it are G53 G53.1 G54 G54.1 G55)
G54.05
