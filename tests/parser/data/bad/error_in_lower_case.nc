; [word-unused] 3:5: error: Q2 has no meaning in this block (hint: Q belongs to G5.1, G8, G64, G68.2, G73, G76, G83 and G87)
g0x0
g1x5q2
