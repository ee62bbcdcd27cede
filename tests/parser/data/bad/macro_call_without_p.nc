; [word-missing] 2:1: error: G65 without P (hint: name the subprogram, for example G65 P2000)
G65 A1 B2
