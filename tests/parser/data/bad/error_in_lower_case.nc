; 3:5: error: Q2 has no meaning in this block (hint: Q belongs to G5.1, G8 and G64)
g0x0
g1x5q2
