; 5:5: error: P10 has no meaning in this block (hint: P belongs to G4, G2, G3, M98, G5.1, G8 and G64)
M98 P2000
M30
O2000
M99 P10
