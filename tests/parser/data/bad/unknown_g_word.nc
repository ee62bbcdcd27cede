; [unknown-word] 3:1: error: unknown word G77 (hint: near it are G73 G74 G76 G80 G81)
G0 X0
G77 X5
