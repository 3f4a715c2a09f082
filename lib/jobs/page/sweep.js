// SPDX-License-Identifier: GPL-3.0-or-later
// The page of weft sweep: a table, a scatter of two figures, parallel coordinates.
"use strict";
onerror=(m)=>{document.body.dataset.error=m};
const $=id=>document.getElementById(id),data=JSON.parse($("data").textContent),NS="http://www.w3.org/2000/svg";
const el=(name,at={},text)=>{const e=document.createElementNS(NS,name);for(const k in at)e.setAttribute(k,at[k]);if(text!==undefined)e.textContent=text;return e};
const clock=s=>s>=3600?`${Math.floor(s/3600)}h ${String(Math.floor(s/60)%60).padStart(2,"0")}m`:`${Math.floor(s/60)}m ${String(Math.round(s)%60).padStart(2,"0")}s`;
const trials=data.trials,ok=trials.filter(t=>t.ok);
// A column: how a trial's figure is read, and shown. Settings that are not numbers are placed by their order of appearance.
const columns=data.axes.map((name,i)=>{const words=[...new Set(trials.map(t=>t.values[i]))];
  const numeric=words.every(w=>w.trim()!==""&&!isNaN(parseFloat(w))&&/^-?[\d.]+ ?%?$/.test(w));
  return {name,words:!numeric,get:t=>numeric?parseFloat(t.values[i]):words.indexOf(t.values[i]),show:t=>t.values[i],ticks:numeric?null:words}});
columns.push({name:"time",better:-1,get:t=>t.time_s,show:t=>clock(t.time_s),tick:clock},{name:"material g",better:-1,get:t=>t.material_g,show:t=>t.material_g.toFixed(2)},
  ...(ok.some(t=>t.cost!==null)?[{name:("cost "+(ok.find(t=>t.currency)?.currency??"")).trim(),better:-1,get:t=>t.cost??NaN,show:t=>t.cost===null?"":t.cost.toFixed(2)}]:[]),
  {name:"strength",better:1,get:t=>t.strength,show:t=>t.strength.toFixed(1)},{name:"layers",get:t=>t.layers,show:t=>t.layers});
const by=name=>columns.find(c=>c.name===name)||columns[0];
const state={x:"time",y:"strength",c:data.axes[0]||"time",sort:"",down:false,kept:{},lit:-1};
for(const [k,v] of new URLSearchParams(location.hash.slice(1))){if(k==="down")state.down=v==="1";else if(k==="keep"){const [n,a,b]=v.split("~");state.kept[n]=[+a,+b]}else if(k in state)state[k]=v}
// Least and greatest; where all trials have the same value it stands in the middle of its axis.
const extent=c=>ok.map(c.get).filter(isFinite).reduce(([a,b],v)=>[Math.min(a,v),Math.max(b,v)],[Infinity,-Infinity]);
const range=c=>{const [a,b]=extent(c);return !isFinite(a)?[0,1]:a===b?[a-.5,b+.5]:[a,b]};
const colour=t=>{const c=by(state.c),[a,b]=range(c),s=(c.get(t)-a)/(b-a);return `hsl(${250-210*s} 70% ${38+10*s}%)`};
const kept=t=>Object.entries(state.kept).every(([n,[a,b]])=>{const v=by(n).get(t);return v>=a&&v<=b});
const label=(c,v)=>c.ticks?(Number.isInteger(v)?c.ticks[v]??"":""):c.tick?c.tick(v):+v.toPrecision(4);
const ticks=c=>{const [least,most]=extent(c);if(least===most)return[least];if(c.ticks)return c.ticks.map((_,i)=>i);const [a,b]=range(c),n=4;return[...Array(n+1)].map((_,i)=>a+(b-a)*i/n)};
function scatter(){const s=$("scatter");s.replaceChildren();const cx=by(state.x),cy=by(state.y),[xa,xb]=range(cx),[ya,yb]=range(cy);
  const px=v=>60+440*(v-xa)/(xb-xa)*.94+13,py=v=>320-290*(v-ya)/(yb-ya)*.94-9;
  for(const v of ticks(cx)){s.append(el("line",{x1:px(v),x2:px(v),y1:20,y2:320,class:"grid"}),el("text",{x:px(v),y:336,"text-anchor":"middle"},label(cx,v)))}
  for(const v of ticks(cy)){s.append(el("line",{x1:60,x2:505,y1:py(v),y2:py(v),class:"grid"}),el("text",{x:55,y:py(v)+4,"text-anchor":"end"},label(cy,v)))}
  s.append(el("text",{x:500,y:354,"text-anchor":"end"},cx.name+" →"),el("text",{x:60,y:14},"↑ "+cy.name));
  // What of the two figures shown no other has better in both: along the first from its best on, whatever is better in the second.
  if(cx.better&&cy.better){let best=-Infinity;const front=[...ok].sort((a,b)=>cx.better*(cx.get(b)-cx.get(a))||cy.better*(cy.get(b)-cy.get(a)))
    .filter(t=>{const v=cy.better*cy.get(t);if(!(v>best))return false;best=v;return true});
    s.append(el("polyline",{class:"front",points:front.map(t=>px(cx.get(t))+","+py(cy.get(t))).join(" "),"data-trials":front.map(t=>t.id).join("|")}))}
  ok.forEach(t=>{const lit=t===trials[state.lit],d=el("circle",{class:"dot",cx:px(cx.get(t)),cy:py(cy.get(t)),r:lit?9:t.best?6:4.5,fill:colour(t),stroke:lit?"#000":t.best?"#c2410c":"#fff","stroke-width":t.best?2:1,opacity:kept(t)?1:.12});
    d.append(el("title",{},t.id+"\n"+["time","material g","strength"].map(n=>n+" "+by(n).show(t)).join(", ")));d.onclick=()=>light(trials.indexOf(t),true);s.append(d)})}
function parallel(){const s=$("parallel");s.replaceChildren();const n=columns.length,px=i=>50+620*i/Math.max(1,n-1),top=30,low=350;
  const py=(c,v)=>{const [a,b]=range(c);return low-(low-top)*(v-a)/(b-a)};
  const lines=el("g",{fill:"none"});[...ok].sort((a,b)=>a.best-b.best).forEach(t=>{const lit=t===trials[state.lit];lines.append(el("polyline",{points:columns.map((c,i)=>px(i)+","+py(c,c.get(t))).join(" "),stroke:lit?"#000":colour(t),"stroke-width":lit?3:t.best?2.2:1.2,opacity:kept(t)?(t.best?1:.55):.05}))});s.append(lines);
  columns.forEach((c,i)=>{s.append(el("line",{x1:px(i),x2:px(i),y1:top,y2:low,class:"axis","stroke-width":1.5}),el("text",{x:px(i),y:i%2?368:18,"text-anchor":i===0?"start":i===n-1?"end":"middle","font-weight":600},c.name));
    for(const v of ticks(c))s.append(el("text",{x:i===n-1?px(i)-5:px(i)+5,y:py(c,v)+4,class:"value","text-anchor":i===n-1?"end":"start"},label(c,v)));
    const k=state.kept[c.name];if(k)s.append(el("rect",{x:px(i)-6,width:12,y:py(c,k[1])-2,height:Math.max(4,py(c,k[0])-py(c,k[1])+4),fill:"#c2410c55",stroke:"#c2410c"}));
    const grip=el("rect",{x:px(i)-14,width:28,y:top-8,height:low-top+16,fill:"transparent",style:"cursor:ns-resize"});
    grip.onpointerdown=e=>{const at=ev=>{const r=s.getBoundingClientRect(),y=(ev.clientY-r.top)*384/r.height,[a,b]=range(c);return a+(b-a)*(low-y)/(low-top)},from=at(e);
      onpointermove=ev=>{const to=at(ev);state.kept[c.name]=[Math.min(from,to),Math.max(from,to)];draw()};onpointerup=()=>{onpointermove=onpointerup=null}};
    grip.ondblclick=()=>{delete state.kept[c.name];draw()};s.append(grip)})}
function table(){const order=trials.map((t,i)=>i);if(state.sort){const c=by(state.sort);order.sort((a,b)=>(trials[b].ok-trials[a].ok)||(state.down?-1:1)*(c.get(trials[a])-c.get(trials[b]))||a-b)}
  $("heads").replaceChildren(...["",...columns.map(c=>c.name),"file"].map(n=>{const h=document.createElement("th");if(columns.some(c=>c.name===n&&!c.words))h.className="n";h.textContent=n+(n&&n===state.sort?(state.down?" ▼":" ▲"):"");if(n&&n!=="file")h.onclick=()=>{state.down=state.sort===n&&!state.down;state.sort=n;draw()};return h}));
  $("rows").replaceChildren(...order.map(i=>{const t=trials[i],r=document.createElement("tr");r.dataset.id=t.id;r.dataset.time=t.time_s;r.className=[t.best?"best":"",t.ok?"":"failed",i===state.lit?"lit":"",t.ok&&!kept(t)?"out":""].join(" ").trim();
    const cell=(text,n)=>{const d=document.createElement("td");d.textContent=text;if(n)d.className="n";r.append(d);return d};
    const picture=cell("");if(t.picture){const m=document.createElement("img");m.src="data:image/png;base64,"+t.picture;m.alt="a layer of "+t.id;if(t.viewer){const l=document.createElement("a");l.href=encodeURIComponent(t.viewer);l.title="look at "+t.id;l.append(m);picture.append(l)}else picture.append(m)}
    columns.forEach((c,k)=>cell(t.ok||k<data.axes.length?c.show(t):"",!c.words));
    if(t.ok){const a=document.createElement("a");a.href=encodeURIComponent(t.output);a.textContent=t.output;const c=cell("");c.append(a);if(t.viewer){const v=document.createElement("a");v.href=encodeURIComponent(t.viewer);v.className="viewer";v.textContent="3-D";c.append(" ",v)}}else cell(t.error);
    r.onclick=()=>light(i,false);return r}))}
function light(i,scroll){state.lit=i;draw();if(scroll)document.querySelector("tr.lit")?.scrollIntoView({block:"nearest"})}
function draw(){scatter();parallel();table();document.body.dataset.kept=ok.filter(kept).length}
document.title=$("title").textContent="weft sweep: "+data.title;
$("facts").textContent=`${trials.length} trials, ${trials.length-ok.length} failed, ${ok.filter(t=>t.best).length} that no other beats`;
for(const k of ["x","y","c"]){$(k).replaceChildren(...columns.map(c=>new Option(c.name,c.name)));$(k).value=state[k];$(k).onchange=()=>{state[k]=$(k).value;draw()}}
draw();document.body.dataset.ready=trials.length;
