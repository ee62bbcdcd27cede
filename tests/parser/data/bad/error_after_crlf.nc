; [word-unused] 4:4: error: Q5 has no meaning in this block (hint: Q belongs to G5.1, G8, G64, G68.2, G73, G76, G83 and G87)
G0 X0

G1 Q5
