; [word-unused] 2:4: error: D1 has no meaning in this block (hint: D belongs to G41, G42 and G96)
T1 D1 M6
