; [axis-words-shared] 2:1: error: G28 and G1 both use the axis words (hint: write two blocks)
G1 G28 Z0 F100
