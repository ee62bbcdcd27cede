; [parameter-unset] 2:5: error: parameter #<depth> has no value (hint: set it on an earlier block: #<depth>=...)
G0 X#<depth>
