# What zsh makes of a line when the tab key is pressed: zsh -f tests/completion.zsh SHARE TEXT
# A shell that says nothing for ten minutes hangs.
zmodload zsh/zpty
zpty -b shell zsh -f -i
zpty -w shell "PS1=; stty -echo; unsetopt zle_bracketed_paste"
zpty -w shell "fpath=($1/zsh/site-functions \$fpath); autoload -U compinit; compinit -u -D"
zpty -w shell 'show() { print -r -- "<$BUFFER>" }; zle -N show; bindkey "^X" show; print READY-$((1 + 1))'
waited=0
until zpty -r -t -m shell text '*READY-2*' || ((waited++ > 6000)); do sleep 0.1; done
zpty -n -w shell "$2"$'\t\x18'
waited=0
until zpty -r -t -m shell text '*<[a-z]*>*' || ((waited++ > 6000)); do sleep 0.1; done
zpty -d shell
print -r -- "$text" | tr -d '\r\a' | sed -n 's/.*<\([a-z].*\)>.*/\1/p' | sed 's/ *$//'
