// Opens a file of this computer: dropped onto the page, or chosen.

const MB = 2 ** 20;

/** Sends a file to the server, and goes to its view. Returns a text about why that failed. */
async function open(file, most) {
  if (!most) return 'This viewer can be reached by other hosts, and takes no files: use "laneloom view FILE".';
  if (file.size > most) return `${file.name} has ${Math.ceil(file.size / MB)} MB; at most ${most / MB} can be dropped: use "laneloom view FILE".`;
  const name = file.name.replace(/[^A-Za-z0-9._-]/g, '_').slice(-100).replace(/^\.+/, '') || 'file';
  try {
    const answer = await fetch(`/open?name=${name}`, {method: 'PUT', body: file});
    if (!answer.ok) return `${file.name} was not opened: ${(await answer.text()).trim()}.`;
    location.assign(`/?view=${(await answer.json()).view}`);
  } catch {
    return `${file.name} was not opened: the server took it not, or there is no connection to laneloom view.`;
  }
}

/** Listens for files. `most`: bytes of a file that the server takes; `veil` is shown while a file is above the page. */
export function listenForFiles({most, veil, input, toast}) {
  const take = async (files) => {
    if (files.length > 1) return toast('One file at a time can be opened.');
    if (!files.length) return;
    toast(`Opening ${files[0].name} …`);
    const failure = await open(files[0], most);
    if (failure) toast(failure);
  };
  const isFile = ({dataTransfer}) => dataTransfer?.types.includes('Files');
  document.addEventListener('dragover', (event) => {
    if (!isFile(event)) return;
    event.preventDefault();
    veil.hidden = false;
  });
  document.addEventListener('dragleave', ({relatedTarget}) => (veil.hidden ||= !relatedTarget));
  document.addEventListener('drop', (event) => {
    if (!isFile(event)) return;
    event.preventDefault();
    veil.hidden = true;
    take(event.dataTransfer.files);
  });
  input.onchange = () => take(input.files);
}
