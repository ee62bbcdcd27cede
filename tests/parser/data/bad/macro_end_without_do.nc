; [flow-unpaired] 2:1: error: there is no loop 2 to which this belongs (hint: it is after its loop, with the same label)
END2
