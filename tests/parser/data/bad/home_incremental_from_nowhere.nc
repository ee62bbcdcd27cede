; [position-unknown] 2:9: error: Z10 is incremental, but Z has not been programmed yet (hint: program Z once in absolute coordinates (G90) first)
G91 G28 Z10
