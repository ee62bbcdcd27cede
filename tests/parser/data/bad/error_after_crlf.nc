; 4:4: error: Q5 has no meaning in this block (hint: Q belongs to G5.1, G8 and G64)
G0 X0

G1 Q5
