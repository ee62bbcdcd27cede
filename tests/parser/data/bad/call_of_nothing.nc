; [missing-subprogram] 2:5: error: subprogram O1234 does not exist (hint: the file holds no subprogram; begin one with O and its number)
M98 P1234
