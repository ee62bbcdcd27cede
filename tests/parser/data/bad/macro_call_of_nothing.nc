; [missing-subprogram] 2:5: error: subprogram O9999 does not exist (hint: the file holds no subprogram; begin one with O and its number)
G65 P9999
