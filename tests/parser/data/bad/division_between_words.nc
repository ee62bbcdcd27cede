; [unexpected-character] 2:7: error: unexpected / between words (hint: block delete stands at the start of the block; division stands in [ ])
G0 X1 / Y2
