; [position-unknown] 4:5: error: X1 is incremental, but X is not known since the change of work offset on line 3 (hint: program X once in absolute coordinates (G90) first)
G0 X5
G56
G91 X1
