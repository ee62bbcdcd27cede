; [name-missing] 2:7: error: the parameter has no name (hint: write #<name>)
G0 X#<>
