; 2:10: error: parameter #7 has no value (hint: set it on an earlier block: #7=...)
#7=3 G0 X#7
