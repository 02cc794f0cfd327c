# zsh -f completion.zsh FOLDER WORDS...: in a terminal of its own, where zsh finds the completion in FOLDER, each of WORDS is typed
# and completed; prints a line each, as it then stands.
zmodload zsh/zpty
zpty shell zsh -f -i
zpty -w shell "
  stty -echo; PROMPT=; RPROMPT=; setopt no_beep
  cd ${(q)1}
  fpath=(${(q)1} \$fpath)
  autoload -Uz compinit && compinit -u -D
  complete-and-tell() { zle complete-word; zle -I; print -r -- '<<'\$BUFFER'>>'; BUFFER= }
  zle -N complete-and-tell
  bindkey '^X' complete-and-tell
  print -r -- '<<''ready>>'"
zpty -r shell seen '*<<ready>>*'
for words in "${@:2}"; do
  zpty -w -n shell "$words"$'\x18'
  zpty -r shell seen '*<<*>>*'
  print -r -- "${${seen##*<<}%%>>*}"
done
zpty -d shell
