; [unexpected-character] 2:7: error: unexpected % inside a block (hint: % is alone on its line)
G0 X1 %
