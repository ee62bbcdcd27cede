; [text-not-closed] 2:12: error: the parameter name is not closed (hint: write #<name>)
G0 X#<depth
