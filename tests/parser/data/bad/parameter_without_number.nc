; [name-missing] 2:6: error: # without a parameter (hint: write #1 or #<name>)
G0 X#
