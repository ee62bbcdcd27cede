; [word-missing] 2:1: error: M98 without P (hint: name the subprogram, for example M98 P2000)
M98
