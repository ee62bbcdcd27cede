; 2:1: error: unknown word M77 (hint: known are M0 M1 M2 M30 M3 M4 M5 M6 M7 M8 M9 M10 M11 M19 M48 M49 M98 M99)
M77
