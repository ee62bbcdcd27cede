; [unknown-word] 2:1: error: unknown word M77 (hint: near it are M48 M49 M60 M98 M99)
M77
