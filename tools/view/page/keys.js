// Keys of the page. Some have a button that does the same.

const PAGE_S = 10;
const ACTIONS = {
  ' ': 'play', l: 'live', Home: 'begin', End: 'live', h: 'heading', n: 'north', f: 'free', '+': 'zoomIn', '=': 'zoomIn', '-': 'zoomOut', r: 'reset',
  '[': 'previous', ']': 'next', Escape: 'escape', '/': 'find', m: 'measure', c: 'link', p: 'png', g: 'svg', d: 'theme', v: 'compare', b: 'save', o: 'open', '?': 'help',
  w: 'up', z: 'down', a: 'left', s: 'right',
};

export function listen(actions) {
  document.addEventListener('keydown', (event) => {
    if (event.ctrlKey || event.altKey || event.metaKey || document.querySelector('dialog[open]')) return;
    const {target, key} = event, typing = /^(INPUT|SELECT|TEXTAREA)$/.test(target.tagName) && target.type !== 'checkbox';
    if (typing) return key === 'Escape' ? target.blur() : undefined;
    if (key === ' ' && /^(BUTTON|SUMMARY|INPUT)$/.test(target.tagName)) return;  // it presses that
    const step = {ArrowLeft: -1, ArrowRight: 1}[key], page = {PageUp: -PAGE_S, PageDown: PAGE_S}[key];
    if (page) actions.skip(page);
    else if (step) event.shiftKey ? actions.skip(step) : actions.step(step);
    else if (/^[1-9]$/.test(key)) actions.layer(Number(key) - 1);
    else if (ACTIONS[key] ?? ACTIONS[key.toLowerCase()]) actions[ACTIONS[key] ?? ACTIONS[key.toLowerCase()]]();
    else return;
    event.preventDefault();
  });
}
