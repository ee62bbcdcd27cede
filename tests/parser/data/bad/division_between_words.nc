; [unexpected-character] 2:7: error: unexpected / between words (hint: block delete is at the start of the block; division is in [ ])
G0 X1 / Y2
