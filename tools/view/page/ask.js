// Requests to the server that the page came from: for its own view, or for that of a file that was opened (?view=…).
const view = new URLSearchParams(location.search).get('view');

/** Fetches `path` of the view that this page shows. */
export const ask = (path) => fetch(view === null ? path : `${path}${path.includes('?') ? '&' : '?'}view=${view}`);
