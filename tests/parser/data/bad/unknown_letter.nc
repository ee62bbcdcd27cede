; [unknown-word] 2:7: error: unknown word E3 (hint: known are the letters A B C F G H I J K L M N O P Q R S T U X Y Z)
G0 X5 E3
