; [position-unknown] 2:8: error: X5 is incremental, but X has not been programmed yet (hint: program X once in absolute coordinates (G90) first)
G91 G0 X5
