; [macro-beside] 2:8: error: G0 beside G65 (hint: write two blocks)
G65 P1 G0 X1
