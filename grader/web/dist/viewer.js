/*! Kinemark's replay viewer. It contains three.js:
The MIT License
Copyright © 2010-2026 three.js authors
Permission is hereby granted, free of charge, to any person obtaining a copy
of this software and associated documentation files (the "Software"), to deal
in the Software without restriction, including without limitation the rights
to use, copy, modify, merge, publish, distribute, sublicense, and/or sell
copies of the Software, and to permit persons to whom the Software is
furnished to do so, subject to the following conditions:
The above copyright notice and this permission notice shall be included in
all copies or substantial portions of the Software.
THE SOFTWARE IS PROVIDED "AS IS", WITHOUT WARRANTY OF ANY KIND, EXPRESS OR
IMPLIED, INCLUDING BUT NOT LIMITED TO THE WARRANTIES OF MERCHANTABILITY,
FITNESS FOR A PARTICULAR PURPOSE AND NONINFRINGEMENT. IN NO EVENT SHALL THE
AUTHORS OR COPYRIGHT HOLDERS BE LIABLE FOR ANY CLAIM, DAMAGES OR OTHER
LIABILITY, WHETHER IN AN ACTION OF CONTRACT, TORT OR OTHERWISE, ARISING FROM,
OUT OF OR IN CONNECTION WITH THE SOFTWARE OR THE USE OR OTHER DEALINGS IN
THE SOFTWARE. */
"use strict";(()=>{function Z(s,e={},...t){let n=document.createElement(s);for(let[i,r]of Object.entries(e))n.setAttribute(i,r);return n.append(...t),n}var Sf="http://www.w3.org/2000/svg";function Ae(s,e={},...t){let n=document.createElementNS(Sf,s);for(let[i,r]of Object.entries(e))n.setAttribute(i,r);return n.append(...t),n}var vl=6,yh=72,wf=7,Ef=11,fi=17,Af=7.4,vr=class{constructor(e,t){this.world=e;this.scale=t;let{space:n,data:i}=e,r=n.basis.length===3?3:1;this.rings=Array.from({length:r},()=>Ae("path",{class:"arm-ring"})),this.arrows=n.active.map(o=>{let{name:a}=i.chain.q[o],l={shaft:Ae("line"),head:Ae("path"),name:Ae("text",{"text-anchor":"middle","dominant-baseline":"central"})};l.name.textContent=a;let c=Ae("g",{class:`arm-arrow arm-colour-${o%vl}`},l.shaft,l.head,l.name);return{...l,group:c,joint:o,wide:.5*Af*a.length+4}}),this.element.append(...this.rings,...this.arrows.map(({group:o})=>o))}world;scale;element=Ae("svg",{class:"arm-marks","aria-hidden":"true"});jacobian=!1;ellipse=!1;arrows;rings;spot=[0,0];draw(e){let{tcpInWorld:t}=this.world,n=[0,0],i=e(n,t);this.drawRings(e,i&&this.ellipse);let r=this.jacobian?this.world.columnsInWorld():[],o=[],a=this.arrows.map(({joint:l})=>this.jacobian?[...this.at(e,r[l])]:n);this.arrows.forEach((l,c)=>{l.group.style.display=i&&this.jacobian?"":"none",this.jacobian&&this.drawArrow(l,a[c],n,Tf(a[c],a,n),o)})}at(e,t){let{tcpInWorld:n}=this.world;return e(this.spot,t.map((i,r)=>n[r]+this.scale*i)),this.spot}drawArrow({shaft:e,head:t,name:n,wide:i},[r,o],[a,l],c,h){let u=Math.hypot(r-a,o-l),[f,d]=u>0?[(r-a)/u,(o-l)/u]:[0,0],g=u>=wf,x=Math.min(Ef,.6*u),p=(M,w)=>{for(let[y,S]of Object.entries(w))M.setAttribute(y,S.toFixed(1))};p(e,{x1:a,y1:l,x2:r-.7*x*f,y2:o-.7*x*d});for(let M of[t,n])M.style.display=g?"":"none";if(!g)return;let m=(M,w)=>`${(r-M*f-w*d).toFixed(1)} ${(o-M*d+w*f).toFixed(1)}`;t.setAttribute("d",`M${m(0,0)}L${m(x,.45*x)}L${m(x,-.45*x)}Z`);let{clientWidth:b,clientHeight:T}=this.element,E=c?{x:r-d*(i+8),y:o+f*fi,wide:i}:{x:r+f*(i+4),y:o+d*fi,wide:i};E.x=Math.min(b-i,Math.max(i,E.x));for(let M of h)Math.abs(E.x-M.x)<i+M.wide&&Math.abs(E.y-M.y)<fi&&(E={...E,y:M.y+(E.y<M.y?-fi:fi)});E.y=Math.min(T-.5*fi,Math.max(.5*fi,E.y)),h.push(E),p(n,{x:E.x,y:E.y})}drawRings(e,t){for(let r of this.rings)r.style.display=t?"":"none";if(!t)return;let n=this.world.ellipse().axes.map(r=>this.world.directionInWorld(r)),i=[[0,1],[0,2],[1,2]];this.rings.forEach((r,o)=>{let[a,l]=i[o].map(h=>n[h]??[0,0,0]),c=Array.from({length:yh},(h,u)=>{let f=2*Math.PI*u/yh,[d,g]=this.at(e,a.map((x,p)=>Math.cos(f)*x+Math.sin(f)*l[p]));return`${d.toFixed(1)} ${g.toFixed(1)}`});r.setAttribute("d",`M${c.join("L")}Z`)})}};function Tf(s,e,[t,n]){let[i,r]=[s[0]-t,s[1]-n],o=Math.hypot(i,r);return e.some(a=>{let[l,c]=[a[0]-t,a[1]-n],h=Math.hypot(l,c);return a!==s&&h>o&&i*l+r*c>.9*o*h})}function Yn(s,e,t,n,i,r){it(s,e,t,n,i[r],i[r+1],i[r+2]);let o=t[n+3],a=t[n+4],l=t[n+5],c=t[n+6],h=i[r+3],u=i[r+4],f=i[r+5],d=i[r+6];s[e+3]=o*h-a*u-l*f-c*d,s[e+4]=o*u+a*h+l*d-c*f,s[e+5]=o*f-a*d+l*h+c*u,s[e+6]=o*d+a*f-l*u+c*h}function it(s,e,t,n,i,r,o){let a=t[n+3],l=t[n+4],c=t[n+5],h=t[n+6],u=2*(c*o-h*r),f=2*(h*i-l*o),d=2*(l*r-c*i);s[e]=t[n]+i+a*u+c*d-h*f,s[e+1]=t[n+1]+r+a*f+h*u-l*d,s[e+2]=t[n+2]+o+a*d+l*f-c*u}function xn(s,e){let t=s[e+3],n=s[e+4],i=s[e+5],r=s[e+6],o=Math.sqrt(t*t+n*n+i*i+r*r),a=o>1e-9?1/o:0;s[e+3]=a>0?t*a:1,s[e+4]=n*a,s[e+5]=i*a,s[e+6]=r*a}var Rf=[0,0,0,1,0,0,0],vn=class{constructor(e){this.chain=e;this.q=new Float64Array(e.q.length),this.poses=new Float64Array(7*e.count),this.axes=new Float64Array(3*e.joints.length),this.poses.set(Rf),this.put(this.q)}chain;q;poses;axes;tcp=new Float64Array(3);lab=new Float64Array(7);moved=new Float64Array(7);rested=new Float64Array(7);put(e){let{chain:t,poses:n,axes:i,moved:r,rested:o}=this;for(let a=0;a<this.q.length;a++)this.q[a]=e[a];for(let a=0;a<t.joints.length;a++){let l=t.joints[a],[c,h,u]=l.axis;Yn(o,0,n,7*l.parent,l.pose,0);let f=l.q===null?0:l.gear*this.q[l.q]+l.offset;if(l.turns){let d=Math.sin(.5*f);r.set([0,0,0,Math.cos(.5*f),d*c,d*h,d*u])}else r.set([f*c,f*h,f*u,1,0,0,0]);Yn(n,7*l.child,o,0,r,0),xn(n,7*l.child),this.turned(i,3*a,7*l.child,l.axis)}return this.point(this.tcp,t.tcp),Yn(this.lab,0,n,7*t.lab.node,t.lab.pose,0),xn(this.lab,0),this}turned(e,t,n,i){it(e,t,this.poses,n,i[0],i[1],i[2]);for(let r=0;r<3;r++)e[t+r]-=this.poses[n+r]}point(e,{node:t,pose:n}){it(e,0,this.poses,7*t,n[0],n[1],n[2])}directionInLab(e,t,n){let[i,r,o,a]=this.lab.subarray(3),l=new Float64Array(3);return it(l,0,[0,0,0,i,-r,-o,-a],0,e,t,n),[l[0],l[1],l[2]]}tcpInLab(){let{tcp:e,lab:t}=this;return this.directionInLab(e[0]-t[0],e[1]-t[1],e[2]-t[2])}};function ms(s){let e=Math.hypot(s.tcp.pose[0],s.tcp.pose[1],s.tcp.pose[2]);for(let{pose:t}of s.joints)e+=Math.hypot(t[0],t[1],t[2]);return e>0?e:1}function $n(s,e){let{unit:t,lower:n,upper:i}=s.q[e],r=t==="rad"?Math.PI:ms(s),o=n??Math.min(-r,(i??r)-2*r),a=i??Math.max(r,o+2*r);return[o,a]}function _r(s,e){let t=[2,3,5,7,11,13,17,19,23,29,31,37],n=(i,r)=>{let[o,a]=[0,1];for(let l=i;l>0;l=Math.floor(l/r))a/=r,o+=a*(l%r);return o};return Array.from({length:e},(i,r)=>s.q.map((o,a)=>{let[l,c]=$n(s,a);return o.unit==="rad"&&c-l>2*Math.PI&&([l,c]=[.5*(l+c)-Math.PI,.5*(l+c)+Math.PI]),l+(c-l)*n(r+1+a,t[a%t.length])}))}var xh={play:"M7 4.5v15l12-7.5z",pause:"M6 5h4.2v14H6zM13.8 5H18v14h-4.2z",back:"M16 5v14l-9-7zM5 5h2.2v14H5z",on:"M8 5v14l9-7zM16.8 5H19v14h-2.2z",previous:"M20 5v14l-8-7zM12 5v14l-8-7z",next:"M4 5v14l8-7zM12 5v14l8-7z",loop:"M7 7h9V4l5 4.5-5 4.5v-3H9v3H7zM17 17H8v3l-5-4.5 5-4.5v3h7v-3h2z",link:"M10.6 13.4a3.6 3.6 0 0 0 5.1 0l3.4-3.4a3.6 3.6 0 0 0-5.1-5.1l-1.4 1.4 1.4 1.4 1.4-1.4a1.6 1.6 0 0 1 2.3 2.3l-3.4 3.4a1.6 1.6 0 0 1-2.3 0zM13.4 10.6a3.6 3.6 0 0 0-5.1 0L4.9 14a3.6 3.6 0 0 0 5.1 5.1l1.4-1.4-1.4-1.4-1.4 1.4a1.6 1.6 0 0 1-2.3-2.3l3.4-3.4a1.6 1.6 0 0 1 2.3 0z",closer:"M11 5h2v6h6v2h-6v6h-2v-6H5v-2h6z",farther:"M5 11h14v2H5z",left:"M14.5 5v14L6 12z",right:"M9.5 5v14l8.5-7z",up:"M5 14.5h14L12 6z",down:"M5 9.5h14L12 18z",full:"M4 4h7v2H6v5H4zM20 20h-7v-2h5v-5h2z",window:"M11 11H4V9h5V4h2zM13 13h7v2h-5v5h-2z",close:"M6.4 5L12 10.6 17.6 5 19 6.4 13.4 12l5.6 5.6-1.4 1.4-5.6-5.6L6.4 19 5 17.6l5.6-5.6L5 6.4z"};function vh(s){return Ae("svg",{viewBox:"0 0 24 24","aria-hidden":"true",class:"replay-icon"},Ae("path",{d:xh[s]}))}function _l(s,e){s.querySelector("path")?.setAttribute("d",xh[e])}var gs={contact:{name:"contact",path:"M6 1.5a4.5 4.5 0 1 0 0 9a4.5 4.5 0 1 0 0-9z"},limit:{name:"limit",path:"M6 1l5.2 9.5H.8z"},saturation:{name:"saturation",path:"M1.8 1.8h8.4v8.4H1.8z"},breach:{name:"first breach",path:"M6 .3L11.7 6 6 11.7.3 6z"},fell:{name:"fell",path:"M6 11L.8 1.5h10.4z"},stop:{name:"stop",path:"M2.6.8L6 4.2 9.4.8l1.8 1.8L7.8 6l3.4 3.4-1.8 1.8L6 7.8l-3.4 3.4L.8 9.4 4.2 6 .8 2.6z"},other:{name:"event",path:"M4.5.5h3v11h-3z"}};function ys(s){return Ae("svg",{viewBox:"0 0 12 12","aria-hidden":"true",class:`replay-mark ${s}`},Ae("path",{d:gs[s].path}))}function bl(s){return Math.min(6,Math.max(0,Math.ceil(-Math.log10(s)-1e-9)))}function Ml(s,e){return String(Number(s.toFixed(Math.min(9,bl(e)+1))))}function Zn(s,e){return`${Ml(s,e)} s`}function Mt(s,e){let t=s.toFixed(e);return Number(t)===0?t.replace("-",""):t}function br(s){return s.split(/(?<=[_.:/-])/).flatMap((e,t)=>t>0?[document.createElement("wbr"),e]:[e])}function Mr(s){let e=gs[s.kind].name;return s.kind==="other"||s.text.toLowerCase().includes(e)?s.text:`${e}: ${s.text}`}var _h=180/Math.PI,bh={rad:[.01,.1],m:[.005,.05]},Cf=0,Sr=class{element;input;output;turns;constructor(e,t,n){let{name:i,unit:r}=e.q[t];this.turns=r==="rad";let[o,a]=$n(e,t),l=`arm-joint-${++Cf}`;this.input=Z("input",{type:"range",class:"replay-slider",id:l,min:String(o),max:String(a),step:"any"}),this.output=Z("span",{class:"arm-value"});let c=Z("i",{class:`arm-swatch arm-colour-${t%vl}`,"aria-hidden":"true"});this.element=Z("div",{class:"arm-joint"},Z("label",{for:l},c,Z("bdi",{},...br(i))),this.input,this.output);let[h,u]=this.turns?bh.rad:bh.m.map(g=>g*(a-o)),f=g=>n(Math.min(a,Math.max(o,g)));this.input.addEventListener("input",()=>{let g=this.input.valueAsNumber;f(g<=o||g>=a?g:Math.round(1e3*g)/1e3)});let d={ArrowLeft:-h,ArrowDown:-h,ArrowRight:h,ArrowUp:h,PageDown:-u,PageUp:u,Home:-1/0,End:1/0};this.input.addEventListener("keydown",g=>{let x=d[g.key];if(x===void 0||g.ctrlKey||g.metaKey||g.altKey)return;g.preventDefault();let p=this.input.valueAsNumber+x;f(Number.isFinite(p)?Number(p.toFixed(6)):p)})}show(e){let{input:t}=this;t.value=String(e);let[n,i]=[Number(t.min),Number(t.max)];t.style.setProperty("--done",`${(100*(e-n)/(i-n||1)).toFixed(2)}%`);let r=this.turns?`${Mt(e,3)} rad, ${Mt(_h*e,1)} degrees`:`${Mt(e,3)} m`;t.setAttribute("aria-valuetext",r),this.output.textContent=this.turns?`${Mt(e,3)} rad  ${Mt(_h*e,1)}\xB0`:`${Mt(e,3)} m`}};function Ai(s){let{chain:e,poses:t,axes:n,tcp:i}=s,r=e.q.map(()=>[0,0,0]),o=e.tcp.node;for(let a=e.joints.length-1;a>=0;a--){let l=e.joints[a];if(l.child!==o||(o=l.parent,l.q===null))continue;let[c,h,u]=[n[3*a],n[3*a+1],n[3*a+2]],f=[c,h,u];if(l.turns){let d=7*l.child,[g,x,p]=[i[0]-t[d],i[1]-t[d+1],i[2]-t[d+2]];f=[h*p-u*x,u*g-c*p,c*x-h*g]}for(let d=0;d<3;d++)r[l.q][d]+=l.gear*f[d]}return r}function wr(s){return Ai(s).map(([e,t,n])=>s.directionInLab(e,t,n))}var Pf=[0,24,12,7],If=60,Lf=1e-12,Mh=1e-4;function Sh(s,{active:e,rank:t}){return s.joints.every(({q:i,gear:r,offset:o})=>i===null||r===1&&o===0&&s.joints.filter(a=>a.q===i).length===1)&&e.length>0&&e.length<=3&&e.length===t}function Sl({active:s}){return s.length<3?1:3}var Er=class{constructor(e,t){this.chain=e;this.space=t;this.at=new vn(e),this.size=ms(e)}chain;space;at;size;find(e){let t=[...this.at.put(e).tcp],n=Array.from(e),i=[n];for(let r of this.starts(n)){let o=this.solve(r,t),a=o&&this.within(o);if(!(!a||i.some(l=>this.same(l,a)))&&(i.push(a),i.length>1+Sl(this.space)))return{others:[],endless:!0}}return{others:i.slice(1),endless:!1}}*starts(e){let{active:t}=this.space,n=Pf[t.length];for(let i=0;i<n**t.length;i++){let r=[...e],o=i;for(let a of t){let[l,c]=$n(this.chain,a);this.chain.q[a].unit==="rad"&&c-l>2*Math.PI&&([l,c]=[-Math.PI,Math.PI]),r[a]=l+(c-l)*(o%n+.5)/n,o=Math.floor(o/n)}yield r}}solve(e,t){let{at:n,size:i,space:r}=this,o=.1,a=this.off(e,t);for(let l=0;l<If;l++){let c=Math.hypot(...a);if(c<=Lf*i)return e;let h=Ai(n),u=Nf(r.active.map(g=>h[g]),a,o*c*c),f=[...e];r.active.forEach((g,x)=>f[g]+=u[x]);let d=this.off(f,t);if(Math.hypot(...d)<c)[e,a]=[f,d],o=Math.max(1e-9,.2*o);else if(this.off(e,t),o=Math.max(1e-6,8*o),o>1e8)return null}return null}off(e,t){let{tcp:n}=this.at.put(e);return t.map((i,r)=>i-n[r])}within(e){let t=[...e];for(let n of this.space.active){let{unit:i,lower:r,upper:o}=this.chain.q[n],a=l=>(r===null||l>=r-1e-9)&&(o===null||l<=o+1e-9);if(i==="rad"){let l=2*Math.PI,c=t[n]-l*Math.round(t[n]/l);t[n]=[c,c-l,c+l].find(a)??NaN}if(!a(t[n]))return null}return t}same(e,t){return this.space.active.every(n=>{let i=e[n]-t[n];return this.chain.q[n].unit!=="rad"?Math.abs(i)<Mh*this.size:Math.abs(i-2*Math.PI*Math.round(i/(2*Math.PI)))<Mh})}};function Nf(s,e,t){let n=s.length,i=(a,l)=>a[0]*l[0]+a[1]*l[1]+a[2]*l[2],r=s.map((a,l)=>[...s.map((c,h)=>i(a,c)+(l===h?t+1e-300:0)),i(a,e)]);for(let a=0;a<n;a++){let l=a;for(let c=a+1;c<n;c++)Math.abs(r[c][a])>Math.abs(r[l][a])&&(l=c);[r[a],r[l]]=[r[l],r[a]];for(let c=a+1;c<n;c++){let h=r[c][a]/r[a][a];for(let u=a;u<=n;u++)r[c][u]-=h*r[a][u]}}let o=new Array(n).fill(0);for(let a=n-1;a>=0;a--){let l=r[a][n];for(let c=a+1;c<n;c++)l-=r[a][c]*o[c];o[a]=l/r[a][a]}return o}function wh(s,{basis:e}){let t=e.map(o=>s.map(a=>a[0]*o[0]+a[1]*o[1]+a[2]*o[2])),n=e.map((o,a)=>e.map((l,c)=>a===c?1:0));for(let o=0,a=!0;a&&o<40;o++){a=!1;for(let l=0;l<t.length;l++)for(let c=l+1;c<t.length;c++)a=Df(t,n,l,c)||a}let i=t.map((o,a)=>{let l=Math.hypot(...o);return{length:l,axis:[0,1,2].map(c=>l*n[a].reduce((h,u,f)=>h+u*e[f][c],0))}});i.sort((o,a)=>a.length-o.length);let r=i.map(({length:o})=>o);return{axes:i.map(({axis:o})=>o),lengths:r,manipulability:s.length<e.length?0:r.reduce((o,a)=>o*a,1)}}function Df(s,e,t,n){let[i,r,o]=[0,0,0];if(s[t].forEach((u,f)=>{let d=s[n][f];i+=u*u,r+=d*d,o+=u*d}),Math.abs(o)<=1e-16*Math.sqrt(i*r)||o===0)return!1;let a=(r-i)/(2*o),l=(a<0?-1:1)/(Math.abs(a)+Math.sqrt(1+a*a)),c=1/Math.sqrt(1+l*l),h=c*l;for(let u of[s,e])u[t].forEach((f,d)=>{let g=u[n][d];u[t][d]=c*f-h*g,u[n][d]=h*f+c*g});return!0}var Ff=.001,Uf=.1;function Eh({lengths:s}){let[e,t]=[s[0]??0,s[s.length-1]??0];return t>Ff*e?t<Uf*e?"nearly singular":"not singular":"singular"}var Of=24,Bf=1e-7,Ar=(s,e)=>s[0]*e[0]+s[1]*e[1]+s[2]*e[2];function Th(s,e,t){let n=[...s];for(let r=0;r<2;r++)for(let o of e)n=n.map((a,l)=>a-Ar(n,o)*o[l]);let i=Math.hypot(...n);return i>t?n.map(r=>r/i):null}function Ah(s,e){let t=[];for(let n of[...s].sort((i,r)=>Ar(r,r)-Ar(i,i))){let i=t.length<3?Th(n,t,e):null;i&&t.push(i)}return t}function Rh(s){let e=new vn(s),t=_r(s,Of).map(a=>wr(e.put(a))),n=Math.max(0,...t.flat().map(a=>Math.hypot(...a))),i=Bf*n,r=Ah(t.flat(),i),o=[];for(let a of[[1,0,0],[0,1,0],[0,0,1]]){let l=a.map((h,u)=>r.reduce((f,d)=>f+Ar(a,d)*d[u],0)),c=o.length<r.length?Th(l,o,1e-6):null;c&&o.push(Math.hypot(...c.map((h,u)=>h-a[u]))<1e-9?a:c)}return{basis:o,active:s.q.flatMap((a,l)=>t.some(c=>Math.hypot(...c[l])>i)?[l]:[]),rank:Math.max(0,...t.map(a=>Ah(a,i).length))}}var kf=22,Ch=8,Ph={others:[],endless:!1},Tr=class{constructor(e){this.data=e;let{chain:t,nodes:n}=e;this.posture=new vn(t),this.other=new vn(t),this.space=Rh(t),this.finder=new Er(t,this.space),this.hasBranches=Sh(t,this.space),this.samples=[this.start(),...this.stretched(),..._r(t,kf)],this.lab=this.posture.lab,this.tcpInWorld=this.posture.tcp;let i=zf(e),r=this.hasBranches?1+Sl(this.space):1,o=[];for(let a=0;a<r;a++)n.forEach(({name:l,shapes:c},h)=>{let u=t.joints.find(({child:f})=>f===h);o.push({name:a===0?l:`posture ${a+1}/${l}`,kind:a===0?"link":"ghost",shapes:c,pose:i.has(h)?null:[...this.posture.poses.subarray(7*h,7*h+7)],parent:u?a*n.length+u.parent:null,track:i.has(h)?0:-1})});this.poses=new Float64Array(7*o.length),this.put(this.start()),this.scenery={stepS:1,ticks:Float64Array.from(this.samples.keys()),lab:{name:e.labName,node:i.has(t.lab.node)?t.lab.node:null,pose:i.has(t.lab.node)?t.lab.pose:[...this.lab]},nodes:o,meshes:e.meshes,frames:[{name:"",...t.tcp}],tcp:{width:3,count:1,values:Float64Array.from(this.tcp)},reference:null,goals:[],paths:[],contacts:[],wanted:null,events:[],ghostLabel:null,mainLabel:null,ended:null}}data;scenery;space;poses;lab;tcp=new Float64Array(3);tcpInWorld;t=0;progress=0;hasBranches;branches=Ph;seeksBranches=!1;posture;other;spot=new Float64Array(3);finder;samples;start(){let{chain:e}=this.data;return e.q.map(({unit:t},n)=>{let[i,r]=$n(e,n),o=t==="rad"?.5+.4*(n%2):i+.6*(r-i);return Math.min(r,Math.max(i,o))})}stretched(){let{chain:e}=this.data;return Array.from({length:Ch},(t,n)=>e.q.map(({unit:i},r)=>{let[o,a]=$n(e,r),l=i==="rad"?r===0?2*Math.PI*n/Ch-Math.PI:0:n%2?o:a;return Math.min(a,Math.max(o,l))}))}get q(){return this.posture.q}put(e){this.posture.put(e),this.poses.set(this.posture.poses),this.tcp.set(this.posture.tcpInLab()),this.branches=this.seeksBranches?this.finder.find(this.q):Ph,this.branches.others.forEach((t,n)=>{this.poses.set(this.other.put(t).poses,(n+1)*this.posture.poses.length)})}seekBranches(e){this.seeksBranches=e&&this.hasBranches,this.put(this.q)}at(e){this.put(this.samples[Math.round(e)]??this.start())}there(e){return e<this.data.nodes.length*(1+this.branches.others.length)}frame(e,t,n){t===null?e.set(n):Yn(e,0,this.poses,7*t,n,0),xn(e,0)}columns(){return wr(this.posture)}columnsInWorld(){return Ai(this.posture)}directionInWorld(e){return it(this.spot,0,this.lab,0,e[0],e[1],e[2]),[0,1,2].map(t=>this.spot[t]-this.lab[t])}velocityScale(){let e=new vn(this.data.chain),t=this.samples.flatMap(o=>Ai(e.put(o))),n=Math.max(1e-9,...t.map(o=>Math.hypot(...o))),i=.3*ms(this.data.chain)/n,r=10**Math.floor(Math.log10(i));return([5,2,1].find(o=>o*r<=i)??1)*r}ellipse(){return wh(this.columns(),this.space)}get hasEllipse(){let{basis:e,rank:t}=this.space;return e.length>=2&&t===e.length}};function zf({chain:s}){let e=new Set;for(let{parent:t,child:n,q:i}of s.joints)(i!==null||e.has(t))&&e.add(n);return e}var Ih=96;function Vf(s){let e=new Float64Array(3*s),t=Math.PI*(3-Math.sqrt(5));for(let n=0;n<s;n++){let i=1-(2*n+1)/s,r=Math.sqrt(1-i*i);e.set([r*Math.cos(t*n),r*Math.sin(t*n),i],3*n)}return e}function wl(s,e,t){let n=new Set,i=Vf(t),r=s.length/e;for(let o=0;o<t;o++){let a=-1/0,l=-1;for(let c=0;c<r;c++){let h=e*c,u=s[h]*i[3*o]+s[h+1]*i[3*o+1]+s[h+2]*i[3*o+2];e===4&&(u+=s[h+3]),u>a&&(a=u,l=c)}l>=0&&n.add(l)}return[...n]}function Gf(s){let e=s.vertices.length/3;return(e<=Ih?Array.from({length:e},(n,i)=>i):wl(s.vertices,3,Ih)).flatMap(n=>[s.vertices[3*n],s.vertices[3*n+1],s.vertices[3*n+2],0])}function Ti(s,e){let t=s.solid,n=[];switch(t.kind){case"box":{let[r,o,a]=t.size;for(let l of[-.5,.5])for(let c of[-.5,.5])for(let h of[-.5,.5])n.push(l*r,c*o,h*a,0);break}case"cylinder":for(let r of[-.5,.5])for(let o=0;o<24;o++){let a=2*Math.PI*o/24;n.push(t.radius*Math.cos(a),t.radius*Math.sin(a),r*t.length,0)}break;case"capsule":n.push(0,0,-.5*t.length,t.radius,0,0,.5*t.length,t.radius);break;case"sphere":n.push(0,0,0,t.radius);break;case"mesh":n.push(...Gf(e[t.mesh]))}let i=new Float64Array(n);for(let r=0;r<i.length;r+=4)it(i,r,s.pose,0,n[r],n[r+1],n[r+2]);return i}var Hf=[0,0,0],Lh=s=>s.shapes.length===0&&(s.kind==="link"||s.kind==="ghost");function Ri(s){let{nodes:e,frames:t}=s,n=[],i=new Set;e.forEach((r,o)=>{r.parent!==null&&(i.add(r.parent),Lh(e[r.parent])&&n.push({from:r.parent,to:o,tip:Hf,ghost:r.kind==="ghost"}))});for(let{node:r,pose:o}of t)r!==null&&Lh(e[r])&&!i.has(r)&&n.push({from:r,to:r,tip:o.slice(0,3),ghost:e[r].kind==="ghost"});return n}function Ci(s,e,t){it(s,0,e.poses,7*t.to,t.tip[0],t.tip[1],t.tip[2])}var Wf=32,Xf=1500,qf=.02,pi=class{low=[1/0,1/0,1/0];high=[-1/0,-1/0,-1/0];add(e,t=0,n=0){for(let i=0;i<3;i++)this.low[i]=Math.min(this.low[i],e[t+i]-n),this.high[i]=Math.max(this.high[i],e[t+i]+n)}get diagonal(){let e=Math.hypot(...this.high.map((t,n)=>t-this.low[n]));return Number.isFinite(e)?e:0}holds(e,t,n){return[0,1,2].every(i=>e[t+i]>=this.low[i]-n&&e[t+i]<=this.high[i]+n)}};function Rr(s,e){let{ticks:t,stepS:n,nodes:i,meshes:r}=s,o=i.map(D=>D.shapes.map(P=>Ti(P,r))),a=[],l=[],c=Ri(s),h=new pi,u=new pi,f=new Float64Array(3),d=Math.min(Wf,t.length),g=(D,P,V)=>{it(f,0,e.lab,0,D[P],D[P+1],D[P+2]),a.push(f[0],f[1],f[2],V)};for(let D=0;D<d;D++){let P=d>1?Math.round(D*(t.length-1)/(d-1)):0;e.at(t[P]*n),i.forEach((V,W)=>{if(D>0&&V.track<0)return;let G=V.kind==="link"||V.kind==="ghost";for(let ee of o[W])for(let X=0;X<ee.length;X+=4)it(f,0,e.poses,7*W,ee[X],ee[X+1],ee[X+2]),(G?a:l).push(f[0],f[1],f[2],ee[X+3]),V.kind==="link"&&u.add(f)});for(let V of c){let W=7*V.from;a.push(e.poses[W],e.poses[W+1],e.poses[W+2],0),Ci(f,e,V),a.push(f[0],f[1],f[2],0),u.add(f)}h.add(e.tcpInWorld);for(let V of s.goals)g(V.position,0,V.full??0);if(D===0||s.lab.node!==null){for(let W of s.paths)for(let G of W.points)g(G,0,W.full??0);let V=s.reference?.path;for(let W of V?[s.tcp,V]:[s.tcp]){let G=Math.ceil(W.count/Xf);for(let ee=0;ee<W.count;ee+=G)g(W.values,3*ee,0)}}}let x=new pi;for(let D=0;D<a.length;D+=4)x.add(a,D,a[D+3]);let p=.35*Math.max(x.diagonal,.001),m=l.length&&x.diagonal>0?new pi:null,b=[...a];for(let D=0;D<l.length;D+=4)x.holds(l,D,p)&&(m?.add(l,D,l[D+3]),b.push(l[D],l[D+1],l[D+2],l[D+3]));let T=new pi;for(let D=0;D<b.length;D+=4)T.add(b,D,b[D+3]);let E=[0,1,2].map(D=>.5*(T.low[D]+T.high[D])),M=Math.max(.5*T.diagonal,.001),w=new Float64Array(wl(b,4,96).flatMap(D=>b.slice(4*D,4*D+4))),y=h.diagonal>.001*M?h:u.diagonal>0?u:T,S=y.high.map((D,P)=>D-y.low[P]),I=1;for(let D of[0,2])S[D]<S[I]-.001*M&&(I=D);e.at(t[0]*n);let R=I===0?1:0,N=0;for(let D of[[1,0,0],[0,1,0],[0,0,1]])it(f,0,[0,0,0,...e.lab.subarray(3)],0,D[0],D[1],D[2]),Math.abs(f[R])>Math.abs(N)+1e-6&&(N=f[R]);let O=T.low[2];return{hull:w,centre:E,radius:M,ground:O<-.02*M?O:0,side:I,flipped:I!==2&&N<-.5,flat:S[I]<qf*M}}function Pi(s,e){let t=s.nodes.filter(l=>l.kind==="link").map(l=>l.name),n=new Set([...t,...t.map(l=>`${s.ghostLabel}/${l}`)]),i=s.contacts.map(l=>({contact:l,arm:n.has(l.first)||n.has(l.second)}));i.sort((l,c)=>Number(c.arm)-Number(l.arm)||c.contact.impulse-l.contact.impulse);let r=Math.max(0,...i.slice(0,1).map(({contact:l})=>l.impulse)),o=Math.max(0,...i.filter(({arm:l})=>l).map(({contact:l})=>l.force)),a=({force:l,normal:c})=>{if(!c||!(o>0)||!(l>0))return null;let h=Math.sqrt(l/o);return c.map(u=>h*u)};return i.slice(0,e).map(({contact:l,arm:c})=>{let h=r>0?Math.min(1,l.impulse/r):1;return{point:l.point,from:l.from,to:l.to,size:c?.65+.35*Math.sqrt(h):.5,lasting:c?1:.45,force:c?a(l):null}})}function Cr(s,e){return e+.5<s.from||e-.5>s.to?0:s.lasting}var Pr=class{times=new Float64Array(600);counted=0;add(e){this.times[this.counted++%600]=e}list(){let e=Math.min(this.counted,600);return Array.from({length:e},(t,n)=>this.times[(this.counted-e+n)%600])}},xs=new Map,vs=[],Nh=[],El=!1;function Al(){El||(El=!0,requestAnimationFrame(Yf))}function Yf(s){El=!1;let e=performance.now();for(let n of xs.keys())n(s);let t=vs;vs=Nh,Nh=t;for(let n=0;n<t.length;n++)t[n](s);t.length=0;for(let n of xs.values())n.add(performance.now()-e);(xs.size>0||vs.length>0)&&Al()}function Dh(s,e){xs.set(s,e),Al()}function Fh(s){xs.delete(s)}function Ii(s){vs.includes(s)||vs.push(s),Al()}function Ir(s,e){let{pose:t}=e;if(e.kind!=="ghost"||t===null)return!1;let n=JSON.stringify(e.shapes);return s.nodes.some(i=>i.kind==="link"&&i.pose!==null&&i.pose.every((r,o)=>Math.abs(r-t[o])<1e-6)&&JSON.stringify(i.shapes)===n)}function Lr(s){let e=[...s].sort((n,i)=>n[0]-i[0]||n[1]-i[1]);if(e.length<3)return e;let t=n=>{let i=[];for(let r of n){for(;i.length>1;){let[o,a]=[i[i.length-2],i[i.length-1]];if((a[0]-o[0])*(r[1]-o[1])-(a[1]-o[1])*(r[0]-o[0])>0)break;i.pop()}i.push(r)}return i.pop(),i};return[...t(e),...t(e.reverse())]}function _s(s,e,t,n=0){let i=1/0,{points:r}=e;for(let o=0;o<r.length;o++){let a=r[o],l=r[Math.min(o+1,r.length-1)],c=[l[0]-a[0],l[1]-a[1],l[2]-a[2]],h=c[0]**2+c[1]**2+c[2]**2,u=h>0?((t[n]-a[0])*c[0]+(t[n+1]-a[1])*c[1]+(t[n+2]-a[2])*c[2])/h:0,f=Math.min(1,Math.max(0,u)),d=[a[0]+f*c[0],a[1]+f*c[1],a[2]+f*c[2]],g=Math.hypot(t[n]-d[0],t[n+1]-d[1],t[n+2]-d[2]);g<i&&(i=g,s.set(d))}return i}function Li(s){let{values:e,count:t}=s.tcp,n=new Float64Array(3),i=[];for(let r of s.paths){let{full:o,points:a}=r;if(o===null||!(o>0)||a.length<2)continue;let l=a[a.length-1],c=new Uint8Array(t),h=!1,u=!1,f=!1;for(let d=0;d<t;d++){let g=_s(n,r,e,3*d);if(h||=g<=o,u||=h&&Math.hypot(n[0]-l[0],n[1]-l[1],n[2]-l[2])>2*o,u&&g<=o&&Math.hypot(n[0]-l[0],n[1]-l[1],n[2]-l[2])<o)break;h&&g>o&&(f=!!(c[d]=1))}f&&i.push({path:r,full:o,off:c})}return i}function Nr(s,e){let t=Math.round(e);for(let n of s)if(n.off[Math.min(n.off.length-1,t)])return n;return null}function Dr(s){let e=s.frames.filter(({name:t})=>t!=="");return e.some(t=>t.name===s.lab.name)?e:[s.lab,...e]}function Fr(s){let e=s/6,t=10**Math.floor(Math.log10(e)),n=e/t;return(n<1.5?1:n<3.5?2:n<7.5?5:10)*t}var Rl={link:["#5d6b7d","#8ba4c0","#c6d2df"],edge:"#566375",fixed:"#c3b297",driven:"#86aa9d",free:"#e0b040",ghost:"#9e4a80",trail:"#006cae",left:"#be1e2d",future:"#4a90c2",reference:"#9e4a80",goal:"#007e5c",contact:"#c65200",velocity:"#1c222c",wanted:"#926400",path:"#007e5c",axes:["#c8102e","#007e3a","#1f4fd8"],grid:"#8a96a5",sky:"#ffffff",earth:"#b9b2a8",light:[1.9,2],shadow:.2},$f={link:["#5f6d80","#7d9ac0","#b6c4d4"],edge:"#8794a5",fixed:"#8f8069",driven:"#5f8f80",free:"#d2a338",ghost:"#e69cc8",trail:"#62b8f0",left:"#ff787d",future:"#487a9b",reference:"#e69cc8",goal:"#38c89c",contact:"#ff9452",velocity:"#e8ebf0",wanted:"#e2b240",path:"#38c89c",axes:["#ff7a85","#5fd38a","#86a8ff"],grid:"#5b6675",sky:"#e6eefc",earth:"#2a2f38",light:[1.3,2],shadow:.45},Tl=matchMedia("(prefers-color-scheme: dark)"),Ur=()=>Tl.matches?$f:Rl;function Uh(s){return Tl.addEventListener("change",s),()=>Tl.removeEventListener("change",s)}function Or(s){let e=0;return s.map(({kind:t})=>t==="link"?Cl(e++):t)}function Cl(s){return s===0?"base":s%2===1?"odd":"even"}function Oh(s,e){let t=["base","odd","even"].indexOf(e);return t<0?s[e]:s.link[t]}var Ni=class{constructor(e,t){this.replay=e;let{count:n}=e.tcp,i=0,r=new Float64Array(3);for(let o=0;o<n;o++)this.actual(r,o),i=Math.max(i,Math.hypot(r[0],r[1],r[2])),this.wanted(r,o)&&(i=Math.max(i,Math.hypot(r[0],r[1],r[2])));this.scale=i>0?.45*t/i:0}replay;scale;actual(e,t){let{ticks:n,stepS:i,tcp:r}=this.replay,o=Math.round(t),a=Math.max(0,o-1),l=Math.min(r.count-1,o+1),c=(n[l]-n[a])*i;for(let h=0;h<3;h++)e[h]=c>0?(r.values[3*l+h]-r.values[3*a+h])/c:0}wanted(e,t){let{wanted:n}=this.replay;if(!n)return!1;let i=Math.min(n.count-1,Math.floor(t+1e-9));for(let r=0;r<3;r++)e[r]=n.values[3*i+r];return!0}tip(e,t){for(let n=0;n<3;n++)e[n]=t[n]+this.scale*e[n]}};var Pl=20,Zf=100,Jf=.35,Kf=["x","y","z"],an=class{constructor(e,t,n,i){this.replay=e;this.world=t;this.across=n.side===0?1:0,this.up=n.side===2?1:2,this.sign=n.flipped?-1:1,this.unit=n.radius,this.labFixed=e.lab.node===null;let[r,o]=this.bounds(n.hull),a=.06*Math.max(o[0]-r[0],o[1]-r[1],.001),l=[r[0]-a,r[1]-a,o[0]-r[0]+2*a,o[1]-r[1]+2*a];this.box=l;let c=M=>Ae("g",{class:M}),h=c("side-grid"),u=c("side-fixed"),f=c("side-ghost"),d=c("side-arm");this.still=c("side-lab");let g=c("side-marks"),x=c("side-frames");x.style.display="none",this.svg=Ae("svg",{viewBox:l.map(M=>M.toFixed(5)).join(" "),class:"replay-side",role:"img","aria-label":i,preserveAspectRatio:"xMidYMid meet"},h,u,this.still,d,f,g,x),this.element=Z("div",{class:"replay-stage flat",tabindex:"0",role:"group","aria-label":i}),this.element.append(this.svg);let p=Fr(n.radius),m=2*n.radius;for(let M=Math.ceil((l[0]-m)/p);M*p<l[0]+l[2]+m;M++)h.append(this.line(M*p,l[1]-m,M*p,l[1]+l[3]+m));for(let M=Math.ceil((l[1]-m)/p);M*p<l[1]+l[3]+m;M++)h.append(this.line(l[0]-m,M*p,l[0]+l[2]+m,M*p));let b=Or(e.nodes);e.nodes.forEach((M,w)=>{for(let y of Ir(e,M)?[]:M.shapes){let S=Ae("path",{class:`side-shape ${b[w]}`});(M.kind==="ghost"?f:M.kind==="fixed"?u:d).append(S),this.outlines.push({path:S,node:w,balls:Ti(y,e.meshes),moves:M.track>=0})}});for(let M of Ri(e)){let w=Ae("line",{class:`side-bone${M.ghost?" ghost":""}`});(M.ghost?f:d).append(w),this.sticks.push({bone:M,line:w})}this.past=Ae("polyline",{class:"side-trail"}),this.dot=Ae("circle",{class:"side-tcp",r:String(.012*this.unit)}),this.left=Li(e),this.velocity=new Ni(e,n.radius),this.drawLab();for(let M of Pi(e,Zf)){let[w,y]=this.flat(M.point),S=Ae("circle",{class:"side-contact",cx:String(w),cy:String(y),r:String(.014*this.unit*M.size)}),{force:I,point:R}=M,N=I?Ae("path",{class:"side-force",d:this.arrowTo([w,y],this.flat(R.map((O,D)=>O+Jf*this.unit*I[D])))}):null;g.append(S),N&&g.append(N),this.marks.push({dot:S,arrow:N,mark:M})}let T=String(.045*this.unit),E=M=>{let w=Ae("text",{"font-size":T,"text-anchor":"middle","dominant-baseline":"central"});return w.textContent=M,w};for(let M of Dr(e)){let w=Kf.map(I=>({line:Ae("line",{class:`side-axis ${I}`}),letter:E(I)})),y=E(M.name),S=Ae("g",{},...w.map(({line:I})=>I),...w.map(({letter:I})=>I),y);x.append(S),this.frames.push({frame:M,group:S,axes:w,name:y})}this.draw(),new ResizeObserver(()=>this.drawnOver&&this.invalidate()).observe(this.element)}replay;world;element;svg;outlines=[];sticks=[];marks=[];past;dot;left;off=Ae("path",{class:"side-left"});arrow=Ae("path",{class:"side-arrow"});velocity;moved=Ae("path",{class:"side-velocity"});wanted=Ae("path",{class:"side-wanted"});moves=!1;frames=[];tip=new Float64Array(3);labFixed;still;trail=[];spot=new Float64Array(7);across;up;sign;unit;first=!0;framesShown=!1;box;drawnOver;bounds(e){let t=[1/0,1/0],n=[-1/0,-1/0];for(let i=0;i<e.length;i+=4)this.flat(e,i).forEach((r,o)=>{t[o]=Math.min(t[o],r-e[i+3]),n[o]=Math.max(n[o],r+e[i+3])});return[t,n]}flat(e,t=0){return[this.sign*e[t+this.across],-e[t+this.up]]}fromLab(e,t=0){return it(this.spot,0,this.world.lab,0,e[t],e[t+1],e[t+2]),this.flat(this.spot)}line(e,t,n,i){return Ae("line",{x1:String(e),y1:String(t),x2:String(n),y2:String(i)})}points(e){let t=[];for(let n=0;n+2<e.length;n+=3)t.push(this.fromLab(e,n).map(i=>i.toFixed(5)).join(","));return t}drawLab(){let{replay:e,still:t,unit:n}=this;t.replaceChildren();for(let i of e.paths){let r=this.points(i.points.flat()).join(" ");for(let[o,a]of[[i.zero,"side-zero"],[i.full,"side-full"]])o!==null&&o>0&&t.append(Ae("polyline",{class:`${a} side-tube`,points:r,"stroke-width":String(2*o)}));t.append(Ae("polyline",{class:"side-path",points:r}))}for(let i of e.goals){let[r,o]=this.fromLab(i.position);for(let[a,l]of[[i.zero,"side-zero"],[i.full,"side-full"],[.01*n,"side-goal"]])a!==null&&a>0&&t.append(Ae("circle",{class:l,cx:String(r),cy:String(o),r:String(a)}))}e.reference&&t.append(Ae("polyline",{class:"side-reference",points:this.points(e.reference.path.values).join(" ")})),this.trail.length=0,this.trail.push(...this.points(e.tcp.values)),t.append(Ae("polyline",{class:"side-future",points:this.trail.join(" ")}),this.past,this.off,this.arrow,this.wanted,this.moved,this.dot)}invalidate(){Ii(this.draw)}show(e,t){e==="frames"&&(this.framesShown=t,this.invalidate()),e==="velocity"&&(this.moves=t,this.invalidate());let n=e==="frames"?".side-frames":e==="ghost"?".side-ghost":null,i=n?this.svg.querySelector(n):null;i&&(i.style.display=t?"":"none")}draw=()=>{let{world:e}=this;!this.labFixed&&!this.first&&this.drawLab();for(let r of this.outlines)(this.first||r.moves)&&r.path.setAttribute("d",this.outline(r));if(this.first=!1,e.there){for(let{path:r,node:o}of this.outlines)r.style.display=e.there(o)?"":"none";for(let{bone:r,line:o}of this.sticks)o.style.display=e.there(r.to)?"":"none"}for(let{bone:r,line:o}of this.sticks){let[a,l]=this.flat(e.poses,7*r.from);Ci(this.spot,e,r);let[c,h]=this.flat(this.spot);for(let[u,f]of[["x1",a],["y1",l],["x2",c],["y2",h]])o.setAttribute(u,f.toFixed(5))}let[t,n]=this.flat(e.tcpInWorld);this.past.setAttribute("points",this.trail.slice(0,Math.floor(e.progress)+1).join(" ")+` ${t.toFixed(5)},${n.toFixed(5)}`),this.dot.setAttribute("cx",t.toFixed(5)),this.dot.setAttribute("cy",n.toFixed(5)),this.left.length>0&&this.drawLeft(t,n);let i=e.t/this.replay.stepS;this.drawVelocities(t,n);for(let{dot:r,arrow:o,mark:a}of this.marks){let l=Cr(a,i);r.style.opacity=String(l),o&&(o.style.display=l>0?"":"none")}if(this.framesShown)for(let r of this.frames)this.drawFrame(r);this.drawnOver?.(this.project)};drawLeft(e,t){let{world:n,trail:i,spot:r}=this,o="",a=Math.floor(n.progress);for(let{off:u}of this.left)for(let f=0;f<a;f++)u[f]&&(o+=`${f>0&&u[f-1]?"L":`M${i[f]}L`}${i[f+1]}`);this.off.setAttribute("d",o);let l=Nr(this.left,n.progress);if(this.arrow.style.display=l?"":"none",!l)return;_s(r,l.path,n.tcp);let[c,h]=this.fromLab([r[0],r[1],r[2]]);this.arrow.setAttribute("d",this.arrowTo([e,t],[c,h]))}arrowTo([e,t],[n,i]){if(Math.hypot(n-e,i-t)<1e-6*this.unit)return"";let r=Math.atan2(i-t,n-e),o=.035*this.unit,a=[2.7,-2.7].map(l=>`M${n} ${i}L${n+o*Math.cos(r+l)} ${i+o*Math.sin(r+l)}`);return`M${e} ${t}L${n} ${i}${a.join("")}`}drawVelocities(e,t){let{world:n,velocity:i,tip:r}=this,o=(a,l)=>{l&&i.tip(r,n.tcp),a.setAttribute("d",l?this.arrowTo([e,t],this.fromLab(r)):"")};this.moves&&i.actual(r,n.progress),o(this.moved,this.moves),o(this.wanted,this.moves&&i.wanted(r,n.progress))}project=(e,t)=>{let{clientWidth:n,clientHeight:i}=this.element,[r,o,a,l]=this.box,c=Math.min(n/a,i/l),[h,u]=this.flat(t);return e[0]=.5*n+c*(h-r-.5*a),e[1]=.5*i+c*(u-o-.5*l),!0};drawFrame({frame:e,axes:t,name:n}){let{spot:i,tip:r,unit:o}=this;this.world.frame(i,e.node,e.pose);let[a,l]=this.flat(i),[c,h]=[0,0];t.forEach(({line:f,letter:d},g)=>{let x=.16*o;it(r,0,i,0,g===0?x:0,g===1?x:0,g===2?x:0);let[p,m]=this.flat(r);for(let[T,E]of[["x1",a],["y1",l],["x2",p],["y2",m]])f.setAttribute(T,E.toFixed(5));let b=Math.hypot(p-a,m-l)>.3*x;d.style.display=b?"":"none",d.setAttribute("x",(a+1.2*(p-a)).toFixed(5)),d.setAttribute("y",(l+1.2*(m-l)).toFixed(5)),c+=p-a,h+=m-l});let u=Math.hypot(c,h)||1;n.setAttribute("x",(a-c/u*.05*o).toFixed(5)),n.setAttribute("y",(l-h/u*.05*o).toFixed(5)),n.setAttribute("text-anchor",c>.3*u?"end":c<-.3*u?"start":"middle")}outline({node:e,balls:t}){let n=[];for(let i=0;i<t.length;i+=4){it(this.spot,0,this.world.poses,7*e,t[i],t[i+1],t[i+2]);let[r,o]=this.flat(this.spot),a=t[i+3];if(a===0)n.push([r,o]);else for(let l=0;l<Pl;l++)n.push([r+a*Math.cos(2*Math.PI*l/Pl),o+a*Math.sin(2*Math.PI*l/Pl)])}return"M"+Lr(n).map(([i,r])=>`${i.toFixed(5)} ${r.toFixed(5)}`).join("L")+"Z"}};var uu=0,ac=1,du=2;var vi=1,fu=2,ss=3,li=0,Ct=1,Gt=2,_i=0,rs=1,lc=2,cc=3,hc=4,pu=5;var bi=100,mu=101,gu=102,yu=103,xu=104,vu=200,_u=201,bu=202,Mu=203,uc=204,dc=205,Su=206,wu=207,Eu=208,Au=209,Tu=210,Ru=211,Cu=212,Pu=213,Iu=214,fo=0,po=1,mo=2,$i=3,go=4,yo=5,xo=6,vo=7,Yo=0,Lu=1,Nu=2,wn=0,fc=1,pc=2,mc=3,gc=4,yc=5,xc=6,vc=7;var _c=300,Mi=301,os=302,$o=303,Zo=304,_o=1e3,bn=1001,bo=1002,wt=1003,Du=1004;var js=1005;var kt=1006,Jo=1007;var Gn=1008;var Ht=1009,bc=1010,Mc=1011,as=1012,Ko=1013,dn=1014,fn=1015,pn=1016,jo=1017,Qo=1018,Si=1020,Sc=35902,wc=35899,Ec=1021,Ac=1022,mn=1023,Un=1026,Hn=1027,Tc=1028,ea=1029,ci=1030,ta=1031;var na=1033,Qs=33776,er=33777,tr=33778,nr=33779,ia=35840,sa=35841,ra=35842,oa=35843,aa=36196,la=37492,ca=37496,ha=37488,ua=37489,ir=37490,da=37491,fa=37808,pa=37809,ma=37810,ga=37811,ya=37812,xa=37813,va=37814,_a=37815,ba=37816,Ma=37817,Sa=37818,wa=37819,Ea=37820,Aa=37821,Ta=36492,Ra=36494,Ca=36495,Pa=36283,Ia=36284,sr=36285,La=36286;var Ts=2300,Mo=2301,co=2302,ec=2303,tc=2400,nc=2401,ic=2402;var Fu=3200;var Na=0,Uu=1,Wn="",Yt="srgb",Rs="srgb-linear",Cs="linear",Ze="srgb";var ho=7680;var Ou=519,Bu=512,ku=513,zu=514,Rc=515,Vu=516,Gu=517,Cc=518,Pc=519,Hu=35044;var Ic="300 es",tn=2e3,Zi=2001;function jf(s){for(let e=s.length-1;e>=0;--e)if(s[e]>=65535)return!0;return!1}function Qf(s){return ArrayBuffer.isView(s)&&!(s instanceof DataView)}function Ps(s){return document.createElementNS("http://www.w3.org/1999/xhtml",s)}function Wu(){let s=Ps("canvas");return s.style.display="block",s}var Bh={},Ji=null;function Lc(...s){let e="THREE."+s.shift();Ji?Ji("log",e,...s):console.log(e,...s)}function Xu(s){let e=s[0];if(typeof e=="string"&&e.startsWith("TSL:")){let t=s[1];t&&t.isStackTrace?s[0]+=" "+t.getLocation():s[1]='Stack trace not available. Enable "THREE.Node.captureStackTrace" to capture stack traces.'}return s}function Ce(...s){s=Xu(s);let e="THREE."+s.shift();if(Ji)Ji("warn",e,...s);else{let t=s[0];t&&t.isStackTrace?console.warn(t.getError(e)):console.warn(e,...s)}}function Le(...s){s=Xu(s);let e="THREE."+s.shift();if(Ji)Ji("error",e,...s);else{let t=s[0];t&&t.isStackTrace?console.error(t.getError(e)):console.error(e,...s)}}function As(...s){let e=s.join(" ");e in Bh||(Bh[e]=!0,Ce(...s))}function qu(s,e,t){return new Promise(function(n,i){function r(){switch(s.clientWaitSync(e,s.SYNC_FLUSH_COMMANDS_BIT,0)){case s.WAIT_FAILED:i();break;case s.TIMEOUT_EXPIRED:setTimeout(r,t);break;default:n()}}setTimeout(r,t)})}var Yu={[fo]:fo,[mo]:xo,[go]:go,[$i]:yo,[po]:po,[xo]:mo,[vo]:vo,[yo]:$i},Mn=class{addEventListener(e,t){this._listeners===void 0&&(this._listeners={});let n=this._listeners;n[e]===void 0&&(n[e]=[]),n[e].indexOf(t)===-1&&n[e].push(t)}hasEventListener(e,t){let n=this._listeners;return n===void 0?!1:n[e]!==void 0&&n[e].indexOf(t)!==-1}removeEventListener(e,t){let n=this._listeners;if(n===void 0)return;let i=n[e];if(i!==void 0){let r=i.indexOf(t);r!==-1&&i.splice(r,1)}}dispatchEvent(e){let t=this._listeners;if(t===void 0)return;let n=t[e.type];if(n!==void 0){e.target=this;let i=n.slice(0);for(let r=0,o=i.length;r<o;r++)i[r].call(this,e);e.target=null}}},Lt=["00","01","02","03","04","05","06","07","08","09","0a","0b","0c","0d","0e","0f","10","11","12","13","14","15","16","17","18","19","1a","1b","1c","1d","1e","1f","20","21","22","23","24","25","26","27","28","29","2a","2b","2c","2d","2e","2f","30","31","32","33","34","35","36","37","38","39","3a","3b","3c","3d","3e","3f","40","41","42","43","44","45","46","47","48","49","4a","4b","4c","4d","4e","4f","50","51","52","53","54","55","56","57","58","59","5a","5b","5c","5d","5e","5f","60","61","62","63","64","65","66","67","68","69","6a","6b","6c","6d","6e","6f","70","71","72","73","74","75","76","77","78","79","7a","7b","7c","7d","7e","7f","80","81","82","83","84","85","86","87","88","89","8a","8b","8c","8d","8e","8f","90","91","92","93","94","95","96","97","98","99","9a","9b","9c","9d","9e","9f","a0","a1","a2","a3","a4","a5","a6","a7","a8","a9","aa","ab","ac","ad","ae","af","b0","b1","b2","b3","b4","b5","b6","b7","b8","b9","ba","bb","bc","bd","be","bf","c0","c1","c2","c3","c4","c5","c6","c7","c8","c9","ca","cb","cc","cd","ce","cf","d0","d1","d2","d3","d4","d5","d6","d7","d8","d9","da","db","dc","dd","de","df","e0","e1","e2","e3","e4","e5","e6","e7","e8","e9","ea","eb","ec","ed","ee","ef","f0","f1","f2","f3","f4","f5","f6","f7","f8","f9","fa","fb","fc","fd","fe","ff"];var uo=Math.PI/180,So=180/Math.PI;function rr(){let s=Math.random()*4294967295|0,e=Math.random()*4294967295|0,t=Math.random()*4294967295|0,n=Math.random()*4294967295|0;return(Lt[s&255]+Lt[s>>8&255]+Lt[s>>16&255]+Lt[s>>24&255]+"-"+Lt[e&255]+Lt[e>>8&255]+"-"+Lt[e>>16&15|64]+Lt[e>>24&255]+"-"+Lt[t&63|128]+Lt[t>>8&255]+"-"+Lt[t>>16&255]+Lt[t>>24&255]+Lt[n&255]+Lt[n>>8&255]+Lt[n>>16&255]+Lt[n>>24&255]).toLowerCase()}function qe(s,e,t){return Math.max(e,Math.min(t,s))}function ep(s,e){return(s%e+e)%e}function Il(s,e,t){return(1-t)*s+t*e}function $u(s){return Math.pow(2,Math.floor(Math.log(s)/Math.LN2))}function Nc(s){switch(s.constructor){case Uint32Array:return 4294967295;case Uint16Array:return 65535;case Uint8Array:case Uint8ClampedArray:return 255;case Int32Array:return 2147483647;case Int16Array:return 32767;case Int8Array:return 127;default:return}}function tp(s,e){if(e.constructor===Float32Array)return s;let t=Nc(e);if(t===void 0)throw new Error("THREE.MathUtils: Invalid component type.");return Math.max(s/t,-1)}function np(s,e){if(e.constructor===Float32Array)return s;let t=Nc(e);if(t===void 0)throw new Error("THREE.MathUtils: Invalid component type.");return Math.round(s*t)}var Be=class{static{this.prototype.isVector2=!0}constructor(e=0,t=0){this.x=e,this.y=t}get width(){return this.x}set width(e){this.x=e}get height(){return this.y}set height(e){this.y=e}set(e,t){return this.x=e,this.y=t,this}setScalar(e){return this.x=e,this.y=e,this}setX(e){return this.x=e,this}setY(e){return this.y=e,this}setComponent(e,t){switch(e){case 0:this.x=t;break;case 1:this.y=t;break;default:throw new Error("THREE.Vector2: index is out of range: "+e)}return this}getComponent(e){switch(e){case 0:return this.x;case 1:return this.y;default:throw new Error("THREE.Vector2: index is out of range: "+e)}}clone(){return new this.constructor(this.x,this.y)}copy(e){return this.x=e.x,this.y=e.y,this}add(e){return this.x+=e.x,this.y+=e.y,this}addScalar(e){return this.x+=e,this.y+=e,this}addVectors(e,t){return this.x=e.x+t.x,this.y=e.y+t.y,this}addScaledVector(e,t){return this.x+=e.x*t,this.y+=e.y*t,this}sub(e){return this.x-=e.x,this.y-=e.y,this}subScalar(e){return this.x-=e,this.y-=e,this}subVectors(e,t){return this.x=e.x-t.x,this.y=e.y-t.y,this}multiply(e){return this.x*=e.x,this.y*=e.y,this}multiplyScalar(e){return this.x*=e,this.y*=e,this}divide(e){return this.x/=e.x,this.y/=e.y,this}divideScalar(e){return this.multiplyScalar(1/e)}applyMatrix3(e){let t=this.x,n=this.y,i=e.elements;return this.x=i[0]*t+i[3]*n+i[6],this.y=i[1]*t+i[4]*n+i[7],this}min(e){return this.x=Math.min(this.x,e.x),this.y=Math.min(this.y,e.y),this}max(e){return this.x=Math.max(this.x,e.x),this.y=Math.max(this.y,e.y),this}clamp(e,t){return this.x=qe(this.x,e.x,t.x),this.y=qe(this.y,e.y,t.y),this}clampScalar(e,t){return this.x=qe(this.x,e,t),this.y=qe(this.y,e,t),this}clampLength(e,t){let n=this.length();return this.divideScalar(n||1).multiplyScalar(qe(n,e,t))}floor(){return this.x=Math.floor(this.x),this.y=Math.floor(this.y),this}ceil(){return this.x=Math.ceil(this.x),this.y=Math.ceil(this.y),this}round(){return this.x=Math.round(this.x),this.y=Math.round(this.y),this}roundToZero(){return this.x=Math.trunc(this.x),this.y=Math.trunc(this.y),this}negate(){return this.x=-this.x,this.y=-this.y,this}dot(e){return this.x*e.x+this.y*e.y}cross(e){return this.x*e.y-this.y*e.x}lengthSq(){return this.x*this.x+this.y*this.y}length(){return Math.sqrt(this.x*this.x+this.y*this.y)}manhattanLength(){return Math.abs(this.x)+Math.abs(this.y)}normalize(){return this.divideScalar(this.length()||1)}angle(){return Math.atan2(-this.y,-this.x)+Math.PI}angleTo(e){let t=Math.sqrt(this.lengthSq()*e.lengthSq());if(t===0)return Math.PI/2;let n=this.dot(e)/t;return Math.acos(qe(n,-1,1))}distanceTo(e){return Math.sqrt(this.distanceToSquared(e))}distanceToSquared(e){let t=this.x-e.x,n=this.y-e.y;return t*t+n*n}manhattanDistanceTo(e){return Math.abs(this.x-e.x)+Math.abs(this.y-e.y)}setLength(e){return this.normalize().multiplyScalar(e)}lerp(e,t){return this.x+=(e.x-this.x)*t,this.y+=(e.y-this.y)*t,this}lerpVectors(e,t,n){return this.x=e.x+(t.x-e.x)*n,this.y=e.y+(t.y-e.y)*n,this}equals(e){return e.x===this.x&&e.y===this.y}fromArray(e,t=0){return this.x=e[t],this.y=e[t+1],this}toArray(e=[],t=0){return e[t]=this.x,e[t+1]=this.y,e}fromBufferAttribute(e,t){return this.x=e.getX(t),this.y=e.getY(t),this}rotateAround(e,t){let n=Math.cos(t),i=Math.sin(t),r=this.x-e.x,o=this.y-e.y;return this.x=r*n-o*i+e.x,this.y=r*i+o*n+e.y,this}random(){return this.x=Math.random(),this.y=Math.random(),this}*[Symbol.iterator](){yield this.x,yield this.y}},nn=class{constructor(e=0,t=0,n=0,i=1){this.isQuaternion=!0,this._x=e,this._y=t,this._z=n,this._w=i}static slerpFlat(e,t,n,i,r,o,a){let l=n[i+0],c=n[i+1],h=n[i+2],u=n[i+3],f=r[o+0],d=r[o+1],g=r[o+2],x=r[o+3];if(u!==x||l!==f||c!==d||h!==g){let p=l*f+c*d+h*g+u*x;p<0&&(f=-f,d=-d,g=-g,x=-x,p=-p);let m=1-a;if(p<.9995){let b=Math.acos(p),T=Math.sin(b);m=Math.sin(m*b)/T,a=Math.sin(a*b)/T,l=l*m+f*a,c=c*m+d*a,h=h*m+g*a,u=u*m+x*a}else{l=l*m+f*a,c=c*m+d*a,h=h*m+g*a,u=u*m+x*a;let b=1/Math.sqrt(l*l+c*c+h*h+u*u);l*=b,c*=b,h*=b,u*=b}}e[t]=l,e[t+1]=c,e[t+2]=h,e[t+3]=u}static multiplyQuaternionsFlat(e,t,n,i,r,o){let a=n[i],l=n[i+1],c=n[i+2],h=n[i+3],u=r[o],f=r[o+1],d=r[o+2],g=r[o+3];return e[t]=a*g+h*u+l*d-c*f,e[t+1]=l*g+h*f+c*u-a*d,e[t+2]=c*g+h*d+a*f-l*u,e[t+3]=h*g-a*u-l*f-c*d,e}get x(){return this._x}set x(e){this._x=e,this._onChangeCallback()}get y(){return this._y}set y(e){this._y=e,this._onChangeCallback()}get z(){return this._z}set z(e){this._z=e,this._onChangeCallback()}get w(){return this._w}set w(e){this._w=e,this._onChangeCallback()}set(e,t,n,i){return this._x=e,this._y=t,this._z=n,this._w=i,this._onChangeCallback(),this}clone(){return new this.constructor(this._x,this._y,this._z,this._w)}copy(e){return this._x=e.x,this._y=e.y,this._z=e.z,this._w=e.w,this._onChangeCallback(),this}setFromEuler(e,t=!0){let n=e._x,i=e._y,r=e._z,o=e._order,a=Math.cos,l=Math.sin,c=a(n/2),h=a(i/2),u=a(r/2),f=l(n/2),d=l(i/2),g=l(r/2);switch(o){case"XYZ":this._x=f*h*u+c*d*g,this._y=c*d*u-f*h*g,this._z=c*h*g+f*d*u,this._w=c*h*u-f*d*g;break;case"YXZ":this._x=f*h*u+c*d*g,this._y=c*d*u-f*h*g,this._z=c*h*g-f*d*u,this._w=c*h*u+f*d*g;break;case"ZXY":this._x=f*h*u-c*d*g,this._y=c*d*u+f*h*g,this._z=c*h*g+f*d*u,this._w=c*h*u-f*d*g;break;case"ZYX":this._x=f*h*u-c*d*g,this._y=c*d*u+f*h*g,this._z=c*h*g-f*d*u,this._w=c*h*u+f*d*g;break;case"YZX":this._x=f*h*u+c*d*g,this._y=c*d*u+f*h*g,this._z=c*h*g-f*d*u,this._w=c*h*u-f*d*g;break;case"XZY":this._x=f*h*u-c*d*g,this._y=c*d*u-f*h*g,this._z=c*h*g+f*d*u,this._w=c*h*u+f*d*g;break;default:Ce("Quaternion: .setFromEuler() encountered an unknown order: "+o)}return t===!0&&this._onChangeCallback(),this}setFromAxisAngle(e,t){let n=t/2,i=Math.sin(n);return this._x=e.x*i,this._y=e.y*i,this._z=e.z*i,this._w=Math.cos(n),this._onChangeCallback(),this}setFromRotationMatrix(e){let t=e.elements,n=t[0],i=t[4],r=t[8],o=t[1],a=t[5],l=t[9],c=t[2],h=t[6],u=t[10],f=n+a+u;if(f>0){let d=.5/Math.sqrt(f+1);this._w=.25/d,this._x=(h-l)*d,this._y=(r-c)*d,this._z=(o-i)*d}else if(n>a&&n>u){let d=2*Math.sqrt(1+n-a-u);this._w=(h-l)/d,this._x=.25*d,this._y=(i+o)/d,this._z=(r+c)/d}else if(a>u){let d=2*Math.sqrt(1+a-n-u);this._w=(r-c)/d,this._x=(i+o)/d,this._y=.25*d,this._z=(l+h)/d}else{let d=2*Math.sqrt(1+u-n-a);this._w=(o-i)/d,this._x=(r+c)/d,this._y=(l+h)/d,this._z=.25*d}return this._onChangeCallback(),this}setFromUnitVectors(e,t){let n=e.dot(t)+1;return n<1e-8?(n=0,Math.abs(e.x)>Math.abs(e.z)?(this._x=-e.y,this._y=e.x,this._z=0,this._w=n):(this._x=0,this._y=-e.z,this._z=e.y,this._w=n)):(this._x=e.y*t.z-e.z*t.y,this._y=e.z*t.x-e.x*t.z,this._z=e.x*t.y-e.y*t.x,this._w=n),this.normalize()}angleTo(e){return 2*Math.acos(Math.abs(qe(this.dot(e),-1,1)))}rotateTowards(e,t){let n=this.angleTo(e);if(n===0)return this;let i=Math.min(1,t/n);return this.slerp(e,i),this}identity(){return this.set(0,0,0,1)}invert(){return this.conjugate()}conjugate(){return this._x*=-1,this._y*=-1,this._z*=-1,this._onChangeCallback(),this}dot(e){return this._x*e._x+this._y*e._y+this._z*e._z+this._w*e._w}lengthSq(){return this._x*this._x+this._y*this._y+this._z*this._z+this._w*this._w}length(){return Math.sqrt(this._x*this._x+this._y*this._y+this._z*this._z+this._w*this._w)}normalize(){let e=this.length();return e===0?(this._x=0,this._y=0,this._z=0,this._w=1):(e=1/e,this._x=this._x*e,this._y=this._y*e,this._z=this._z*e,this._w=this._w*e),this._onChangeCallback(),this}multiply(e){return this.multiplyQuaternions(this,e)}premultiply(e){return this.multiplyQuaternions(e,this)}multiplyQuaternions(e,t){let n=e._x,i=e._y,r=e._z,o=e._w,a=t._x,l=t._y,c=t._z,h=t._w;return this._x=n*h+o*a+i*c-r*l,this._y=i*h+o*l+r*a-n*c,this._z=r*h+o*c+n*l-i*a,this._w=o*h-n*a-i*l-r*c,this._onChangeCallback(),this}slerp(e,t){let n=e._x,i=e._y,r=e._z,o=e._w,a=this.dot(e);a<0&&(n=-n,i=-i,r=-r,o=-o,a=-a);let l=1-t;if(a<.9995){let c=Math.acos(a),h=Math.sin(c);l=Math.sin(l*c)/h,t=Math.sin(t*c)/h,this._x=this._x*l+n*t,this._y=this._y*l+i*t,this._z=this._z*l+r*t,this._w=this._w*l+o*t,this._onChangeCallback()}else this._x=this._x*l+n*t,this._y=this._y*l+i*t,this._z=this._z*l+r*t,this._w=this._w*l+o*t,this.normalize();return this}slerpQuaternions(e,t,n){return this.copy(e).slerp(t,n)}random(){let e=2*Math.PI*Math.random(),t=2*Math.PI*Math.random(),n=Math.random(),i=Math.sqrt(1-n),r=Math.sqrt(n);return this.set(i*Math.sin(e),i*Math.cos(e),r*Math.sin(t),r*Math.cos(t))}equals(e){return e._x===this._x&&e._y===this._y&&e._z===this._z&&e._w===this._w}fromArray(e,t=0){return this._x=e[t],this._y=e[t+1],this._z=e[t+2],this._w=e[t+3],this._onChangeCallback(),this}toArray(e=[],t=0){return e[t]=this._x,e[t+1]=this._y,e[t+2]=this._z,e[t+3]=this._w,e}fromBufferAttribute(e,t){return this._x=e.getX(t),this._y=e.getY(t),this._z=e.getZ(t),this._w=e.getW(t),this._onChangeCallback(),this}toJSON(){return this.toArray()}_onChange(e){return this._onChangeCallback=e,this}_onChangeCallback(){}*[Symbol.iterator](){yield this._x,yield this._y,yield this._z,yield this._w}},U=class{static{this.prototype.isVector3=!0}constructor(e=0,t=0,n=0){this.x=e,this.y=t,this.z=n}set(e,t,n){return n===void 0&&(n=this.z),this.x=e,this.y=t,this.z=n,this}setScalar(e){return this.x=e,this.y=e,this.z=e,this}setX(e){return this.x=e,this}setY(e){return this.y=e,this}setZ(e){return this.z=e,this}setComponent(e,t){switch(e){case 0:this.x=t;break;case 1:this.y=t;break;case 2:this.z=t;break;default:throw new Error("THREE.Vector3: index is out of range: "+e)}return this}getComponent(e){switch(e){case 0:return this.x;case 1:return this.y;case 2:return this.z;default:throw new Error("THREE.Vector3: index is out of range: "+e)}}clone(){return new this.constructor(this.x,this.y,this.z)}copy(e){return this.x=e.x,this.y=e.y,this.z=e.z,this}add(e){return this.x+=e.x,this.y+=e.y,this.z+=e.z,this}addScalar(e){return this.x+=e,this.y+=e,this.z+=e,this}addVectors(e,t){return this.x=e.x+t.x,this.y=e.y+t.y,this.z=e.z+t.z,this}addScaledVector(e,t){return this.x+=e.x*t,this.y+=e.y*t,this.z+=e.z*t,this}sub(e){return this.x-=e.x,this.y-=e.y,this.z-=e.z,this}subScalar(e){return this.x-=e,this.y-=e,this.z-=e,this}subVectors(e,t){return this.x=e.x-t.x,this.y=e.y-t.y,this.z=e.z-t.z,this}multiply(e){return this.x*=e.x,this.y*=e.y,this.z*=e.z,this}multiplyScalar(e){return this.x*=e,this.y*=e,this.z*=e,this}multiplyVectors(e,t){return this.x=e.x*t.x,this.y=e.y*t.y,this.z=e.z*t.z,this}applyEuler(e){return this.applyQuaternion(kh.setFromEuler(e))}applyAxisAngle(e,t){return this.applyQuaternion(kh.setFromAxisAngle(e,t))}applyMatrix3(e){let t=this.x,n=this.y,i=this.z,r=e.elements;return this.x=r[0]*t+r[3]*n+r[6]*i,this.y=r[1]*t+r[4]*n+r[7]*i,this.z=r[2]*t+r[5]*n+r[8]*i,this}applyNormalMatrix(e){return this.applyMatrix3(e).normalize()}applyMatrix4(e){let t=this.x,n=this.y,i=this.z,r=e.elements,o=1/(r[3]*t+r[7]*n+r[11]*i+r[15]);return this.x=(r[0]*t+r[4]*n+r[8]*i+r[12])*o,this.y=(r[1]*t+r[5]*n+r[9]*i+r[13])*o,this.z=(r[2]*t+r[6]*n+r[10]*i+r[14])*o,this}applyQuaternion(e){let t=this.x,n=this.y,i=this.z,r=e.x,o=e.y,a=e.z,l=e.w,c=2*(o*i-a*n),h=2*(a*t-r*i),u=2*(r*n-o*t);return this.x=t+l*c+o*u-a*h,this.y=n+l*h+a*c-r*u,this.z=i+l*u+r*h-o*c,this}project(e){return this.applyMatrix4(e.matrixWorldInverse).applyMatrix4(e.projectionMatrix)}unproject(e){return this.applyMatrix4(e.projectionMatrixInverse).applyMatrix4(e.matrixWorld)}transformDirection(e){let t=this.x,n=this.y,i=this.z,r=e.elements;return this.x=r[0]*t+r[4]*n+r[8]*i,this.y=r[1]*t+r[5]*n+r[9]*i,this.z=r[2]*t+r[6]*n+r[10]*i,this.normalize()}divide(e){return this.x/=e.x,this.y/=e.y,this.z/=e.z,this}divideScalar(e){return this.multiplyScalar(1/e)}min(e){return this.x=Math.min(this.x,e.x),this.y=Math.min(this.y,e.y),this.z=Math.min(this.z,e.z),this}max(e){return this.x=Math.max(this.x,e.x),this.y=Math.max(this.y,e.y),this.z=Math.max(this.z,e.z),this}clamp(e,t){return this.x=qe(this.x,e.x,t.x),this.y=qe(this.y,e.y,t.y),this.z=qe(this.z,e.z,t.z),this}clampScalar(e,t){return this.x=qe(this.x,e,t),this.y=qe(this.y,e,t),this.z=qe(this.z,e,t),this}clampLength(e,t){let n=this.length();return this.divideScalar(n||1).multiplyScalar(qe(n,e,t))}floor(){return this.x=Math.floor(this.x),this.y=Math.floor(this.y),this.z=Math.floor(this.z),this}ceil(){return this.x=Math.ceil(this.x),this.y=Math.ceil(this.y),this.z=Math.ceil(this.z),this}round(){return this.x=Math.round(this.x),this.y=Math.round(this.y),this.z=Math.round(this.z),this}roundToZero(){return this.x=Math.trunc(this.x),this.y=Math.trunc(this.y),this.z=Math.trunc(this.z),this}negate(){return this.x=-this.x,this.y=-this.y,this.z=-this.z,this}dot(e){return this.x*e.x+this.y*e.y+this.z*e.z}lengthSq(){return this.x*this.x+this.y*this.y+this.z*this.z}length(){return Math.sqrt(this.x*this.x+this.y*this.y+this.z*this.z)}manhattanLength(){return Math.abs(this.x)+Math.abs(this.y)+Math.abs(this.z)}normalize(){return this.divideScalar(this.length()||1)}setLength(e){return this.normalize().multiplyScalar(e)}lerp(e,t){return this.x+=(e.x-this.x)*t,this.y+=(e.y-this.y)*t,this.z+=(e.z-this.z)*t,this}lerpVectors(e,t,n){return this.x=e.x+(t.x-e.x)*n,this.y=e.y+(t.y-e.y)*n,this.z=e.z+(t.z-e.z)*n,this}cross(e){return this.crossVectors(this,e)}crossVectors(e,t){let n=e.x,i=e.y,r=e.z,o=t.x,a=t.y,l=t.z;return this.x=i*l-r*a,this.y=r*o-n*l,this.z=n*a-i*o,this}projectOnVector(e){let t=e.lengthSq();if(t===0)return this.set(0,0,0);let n=e.dot(this)/t;return this.copy(e).multiplyScalar(n)}projectOnPlane(e){return Ll.copy(this).projectOnVector(e),this.sub(Ll)}reflect(e){return this.sub(Ll.copy(e).multiplyScalar(2*this.dot(e)))}angleTo(e){let t=Math.sqrt(this.lengthSq()*e.lengthSq());if(t===0)return Math.PI/2;let n=this.dot(e)/t;return Math.acos(qe(n,-1,1))}distanceTo(e){return Math.sqrt(this.distanceToSquared(e))}distanceToSquared(e){let t=this.x-e.x,n=this.y-e.y,i=this.z-e.z;return t*t+n*n+i*i}manhattanDistanceTo(e){return Math.abs(this.x-e.x)+Math.abs(this.y-e.y)+Math.abs(this.z-e.z)}setFromSpherical(e){return this.setFromSphericalCoords(e.radius,e.phi,e.theta)}setFromSphericalCoords(e,t,n){let i=Math.sin(t)*e;return this.x=i*Math.sin(n),this.y=Math.cos(t)*e,this.z=i*Math.cos(n),this}setFromCylindrical(e){return this.setFromCylindricalCoords(e.radius,e.theta,e.y)}setFromCylindricalCoords(e,t,n){return this.x=e*Math.sin(t),this.y=n,this.z=e*Math.cos(t),this}setFromMatrixPosition(e){let t=e.elements;return this.x=t[12],this.y=t[13],this.z=t[14],this}setFromMatrixScale(e){let t=this.setFromMatrixColumn(e,0).length(),n=this.setFromMatrixColumn(e,1).length(),i=this.setFromMatrixColumn(e,2).length();return this.x=t,this.y=n,this.z=i,this}setFromMatrixColumn(e,t){return this.fromArray(e.elements,t*4)}setFromMatrix3Column(e,t){return this.fromArray(e.elements,t*3)}setFromEuler(e){return this.x=e._x,this.y=e._y,this.z=e._z,this}setFromColor(e){return this.x=e.r,this.y=e.g,this.z=e.b,this}equals(e){return e.x===this.x&&e.y===this.y&&e.z===this.z}fromArray(e,t=0){return this.x=e[t],this.y=e[t+1],this.z=e[t+2],this}toArray(e=[],t=0){return e[t]=this.x,e[t+1]=this.y,e[t+2]=this.z,e}fromBufferAttribute(e,t){return this.x=e.getX(t),this.y=e.getY(t),this.z=e.getZ(t),this}random(){return this.x=Math.random(),this.y=Math.random(),this.z=Math.random(),this}randomDirection(){let e=Math.random()*Math.PI*2,t=Math.random()*2-1,n=Math.sqrt(1-t*t);return this.x=n*Math.cos(e),this.y=t,this.z=n*Math.sin(e),this}*[Symbol.iterator](){yield this.x,yield this.y,yield this.z}},Ll=new U,kh=new nn,Ne=class{static{this.prototype.isMatrix3=!0}constructor(e,t,n,i,r,o,a,l,c){this.elements=[1,0,0,0,1,0,0,0,1],e!==void 0&&this.set(e,t,n,i,r,o,a,l,c)}set(e,t,n,i,r,o,a,l,c){let h=this.elements;return h[0]=e,h[1]=i,h[2]=a,h[3]=t,h[4]=r,h[5]=l,h[6]=n,h[7]=o,h[8]=c,this}identity(){return this.set(1,0,0,0,1,0,0,0,1),this}copy(e){let t=this.elements,n=e.elements;return t[0]=n[0],t[1]=n[1],t[2]=n[2],t[3]=n[3],t[4]=n[4],t[5]=n[5],t[6]=n[6],t[7]=n[7],t[8]=n[8],this}extractBasis(e,t,n){return e.setFromMatrix3Column(this,0),t.setFromMatrix3Column(this,1),n.setFromMatrix3Column(this,2),this}setFromMatrix4(e){let t=e.elements;return this.set(t[0],t[4],t[8],t[1],t[5],t[9],t[2],t[6],t[10]),this}multiply(e){return this.multiplyMatrices(this,e)}premultiply(e){return this.multiplyMatrices(e,this)}multiplyMatrices(e,t){let n=e.elements,i=t.elements,r=this.elements,o=n[0],a=n[3],l=n[6],c=n[1],h=n[4],u=n[7],f=n[2],d=n[5],g=n[8],x=i[0],p=i[3],m=i[6],b=i[1],T=i[4],E=i[7],M=i[2],w=i[5],y=i[8];return r[0]=o*x+a*b+l*M,r[3]=o*p+a*T+l*w,r[6]=o*m+a*E+l*y,r[1]=c*x+h*b+u*M,r[4]=c*p+h*T+u*w,r[7]=c*m+h*E+u*y,r[2]=f*x+d*b+g*M,r[5]=f*p+d*T+g*w,r[8]=f*m+d*E+g*y,this}multiplyScalar(e){let t=this.elements;return t[0]*=e,t[3]*=e,t[6]*=e,t[1]*=e,t[4]*=e,t[7]*=e,t[2]*=e,t[5]*=e,t[8]*=e,this}determinant(){let e=this.elements,t=e[0],n=e[1],i=e[2],r=e[3],o=e[4],a=e[5],l=e[6],c=e[7],h=e[8];return t*o*h-t*a*c-n*r*h+n*a*l+i*r*c-i*o*l}invert(){let e=this.elements,t=e[0],n=e[1],i=e[2],r=e[3],o=e[4],a=e[5],l=e[6],c=e[7],h=e[8],u=h*o-a*c,f=a*l-h*r,d=c*r-o*l,g=t*u+n*f+i*d;if(g===0)return this.set(0,0,0,0,0,0,0,0,0);let x=1/g;return e[0]=u*x,e[1]=(i*c-h*n)*x,e[2]=(a*n-i*o)*x,e[3]=f*x,e[4]=(h*t-i*l)*x,e[5]=(i*r-a*t)*x,e[6]=d*x,e[7]=(n*l-c*t)*x,e[8]=(o*t-n*r)*x,this}transpose(){let e,t=this.elements;return e=t[1],t[1]=t[3],t[3]=e,e=t[2],t[2]=t[6],t[6]=e,e=t[5],t[5]=t[7],t[7]=e,this}getNormalMatrix(e){return this.setFromMatrix4(e).invert().transpose()}transposeIntoArray(e){let t=this.elements;return e[0]=t[0],e[1]=t[3],e[2]=t[6],e[3]=t[1],e[4]=t[4],e[5]=t[7],e[6]=t[2],e[7]=t[5],e[8]=t[8],this}setUvTransform(e,t,n,i,r,o,a){let l=Math.cos(r),c=Math.sin(r);return this.set(n*l,n*c,-n*(l*o+c*a)+o+e,-i*c,i*l,-i*(-c*o+l*a)+a+t,0,0,1),this}scale(e,t){return As("Matrix3: .scale() is deprecated. Use .makeScale() instead."),this.premultiply(Nl.makeScale(e,t)),this}rotate(e){return As("Matrix3: .rotate() is deprecated. Use .makeRotation() instead."),this.premultiply(Nl.makeRotation(-e)),this}translate(e,t){return As("Matrix3: .translate() is deprecated. Use .makeTranslation() instead."),this.premultiply(Nl.makeTranslation(e,t)),this}makeTranslation(e,t){return e.isVector2?this.set(1,0,e.x,0,1,e.y,0,0,1):this.set(1,0,e,0,1,t,0,0,1),this}makeRotation(e){let t=Math.cos(e),n=Math.sin(e);return this.set(t,-n,0,n,t,0,0,0,1),this}makeScale(e,t){return this.set(e,0,0,0,t,0,0,0,1),this}equals(e){let t=this.elements,n=e.elements;for(let i=0;i<9;i++)if(t[i]!==n[i])return!1;return!0}fromArray(e,t=0){for(let n=0;n<9;n++)this.elements[n]=e[n+t];return this}toArray(e=[],t=0){let n=this.elements;return e[t]=n[0],e[t+1]=n[1],e[t+2]=n[2],e[t+3]=n[3],e[t+4]=n[4],e[t+5]=n[5],e[t+6]=n[6],e[t+7]=n[7],e[t+8]=n[8],e}clone(){return new this.constructor().fromArray(this.elements)}},Nl=new Ne,zh=new Ne().set(.4123908,.3575843,.1804808,.212639,.7151687,.0721923,.0193308,.1191948,.9505322),Vh=new Ne().set(3.2409699,-1.5373832,-.4986108,-.9692436,1.8759675,.0415551,.0556301,-.203977,1.0569715);function ip(){let s={enabled:!0,workingColorSpace:Rs,spaces:{},convert:function(i,r,o){return this.enabled===!1||r===o||!r||!o||(this.spaces[r].transfer===Ze&&(i.r=Fn(i.r),i.g=Fn(i.g),i.b=Fn(i.b)),this.spaces[r].primaries!==this.spaces[o].primaries&&(i.applyMatrix3(this.spaces[r].toXYZ),i.applyMatrix3(this.spaces[o].fromXYZ)),this.spaces[o].transfer===Ze&&(i.r=Yi(i.r),i.g=Yi(i.g),i.b=Yi(i.b))),i},workingToColorSpace:function(i,r){return this.convert(i,this.workingColorSpace,r)},colorSpaceToWorking:function(i,r){return this.convert(i,r,this.workingColorSpace)},getPrimaries:function(i){return this.spaces[i].primaries},getTransfer:function(i){return i===Wn?Cs:this.spaces[i].transfer},getToneMappingMode:function(i){return this.spaces[i].outputColorSpaceConfig.toneMappingMode||"standard"},getLuminanceCoefficients:function(i,r=this.workingColorSpace){return i.fromArray(this.spaces[r].luminanceCoefficients)},define:function(i){Object.assign(this.spaces,i)},_getMatrix:function(i,r,o){return i.copy(this.spaces[o].fromXYZ).multiply(this.spaces[r].toXYZ)},_getDrawingBufferColorSpace:function(i){return this.spaces[i].outputColorSpaceConfig.drawingBufferColorSpace},_getUnpackColorSpace:function(i=this.workingColorSpace){return this.spaces[i].workingColorSpaceConfig.unpackColorSpace}},e=[.64,.33,.3,.6,.15,.06],t=[.2126,.7152,.0722],n=[.3127,.329];return s.define({[Rs]:{primaries:e,whitePoint:n,transfer:Cs,toXYZ:zh,fromXYZ:Vh,luminanceCoefficients:t,workingColorSpaceConfig:{unpackColorSpace:Yt},outputColorSpaceConfig:{drawingBufferColorSpace:Yt}},[Yt]:{primaries:e,whitePoint:n,transfer:Ze,toXYZ:zh,fromXYZ:Vh,luminanceCoefficients:t,outputColorSpaceConfig:{drawingBufferColorSpace:Yt}}}),s}var Xe=ip();function Fn(s){return s<.04045?s*.0773993808:Math.pow(s*.9478672986+.0521327014,2.4)}function Yi(s){return s<.0031308?s*12.92:1.055*Math.pow(s,.41666)-.055}var Di,wo=class{static getDataURL(e,t="image/png"){if(/^data:/i.test(e.src)||typeof HTMLCanvasElement>"u")return e.src;let n;if(e instanceof HTMLCanvasElement)n=e;else{Di===void 0&&(Di=Ps("canvas")),Di.width=e.width,Di.height=e.height;let i=Di.getContext("2d");e instanceof ImageData?i.putImageData(e,0,0):i.drawImage(e,0,0,e.width,e.height),n=Di}return n.toDataURL(t)}static sRGBToLinear(e){if(typeof HTMLImageElement<"u"&&e instanceof HTMLImageElement||typeof HTMLCanvasElement<"u"&&e instanceof HTMLCanvasElement||typeof ImageBitmap<"u"&&e instanceof ImageBitmap){let t=Ps("canvas");t.width=e.width,t.height=e.height;let n=t.getContext("2d");n.drawImage(e,0,0,e.width,e.height);let i=n.getImageData(0,0,e.width,e.height),r=i.data;for(let o=0;o<r.length;o++)r[o]=Fn(r[o]/255)*255;return n.putImageData(i,0,0),t}else if(e.data){let t=e.data.slice(0);for(let n=0;n<t.length;n++)t instanceof Uint8Array||t instanceof Uint8ClampedArray?t[n]=Math.floor(Fn(t[n]/255)*255):t[n]=Fn(t[n]);return{data:t,width:e.width,height:e.height}}else return Ce("ImageUtils.sRGBToLinear(): Unsupported image type. No color space conversion applied."),e}},sp=0,Ki=class{constructor(e=null){this.isTextureSource=!0,Object.defineProperty(this,"id",{value:sp++}),this.uuid=rr(),this.data=e,this.dataReady=!0,this.version=0}getSize(e){let t=this.data;return typeof HTMLVideoElement<"u"&&t instanceof HTMLVideoElement?e.set(t.videoWidth,t.videoHeight,0):typeof VideoFrame<"u"&&t instanceof VideoFrame?e.set(t.displayWidth,t.displayHeight,0):t!==null?e.set(t.width||0,t.height||0,t.depth||0):e.set(0,0,0),e}set needsUpdate(e){e===!0&&this.version++}toJSON(e){let t=e===void 0||typeof e=="string";if(!t&&e.images[this.uuid]!==void 0)return e.images[this.uuid];let n={uuid:this.uuid,url:""},i=this.data;if(i!==null){let r;if(Array.isArray(i)){r=[];for(let o=0,a=i.length;o<a;o++)i[o].isDataTexture?r.push(Dl(i[o].image)):r.push(Dl(i[o]))}else r=Dl(i);n.url=r}return t||(e.images[this.uuid]=n),n}};function Dl(s){return typeof HTMLImageElement<"u"&&s instanceof HTMLImageElement||typeof HTMLCanvasElement<"u"&&s instanceof HTMLCanvasElement||typeof ImageBitmap<"u"&&s instanceof ImageBitmap?wo.getDataURL(s):s.data?{data:Array.from(s.data),width:s.width,height:s.height,type:s.data.constructor.name}:(Ce("Texture: Unable to serialize Texture."),{})}var rp=0,Fl=new U,Vt=class s extends Mn{constructor(e=s.DEFAULT_IMAGE,t=s.DEFAULT_MAPPING,n=bn,i=bn,r=kt,o=Gn,a=mn,l=Ht,c=s.DEFAULT_ANISOTROPY,h=Wn){super(),this.isTexture=!0,Object.defineProperty(this,"id",{value:rp++}),this.uuid=rr(),this.name="",this.source=new Ki(e),this.mipmaps=[],this.mapping=t,this.channel=0,this.wrapS=n,this.wrapT=i,this.magFilter=r,this.minFilter=o,this.anisotropy=c,this.format=a,this.internalFormat=null,this.type=l,this.offset=new Be(0,0),this.repeat=new Be(1,1),this.center=new Be(0,0),this.rotation=0,this.matrixAutoUpdate=!0,this.matrix=new Ne,this.generateMipmaps=!0,this.mipmapsAutoUpdate=!0,this.premultiplyAlpha=!1,this.flipY=!0,this.unpackAlignment=4,this.colorSpace=h,this.userData={},this.updateRanges=[],this.version=0,this.onUpdate=null,this.renderTarget=null,this.isRenderTargetTexture=!1,this.isArrayTexture=!!(e&&e.depth&&e.depth>1),this.pmremVersion=0,this.isPMREMTexture=!1,this.normalized=!1}get width(){return this.source.getSize(Fl).x}get height(){return this.source.getSize(Fl).y}get depth(){return this.source.getSize(Fl).z}get image(){return this.source.data}set image(e){this.source.data=e}updateMatrix(){this.matrix.setUvTransform(this.offset.x,this.offset.y,this.repeat.x,this.repeat.y,this.rotation,this.center.x,this.center.y)}addUpdateRange(e,t){this.updateRanges.push({start:e,count:t})}clearUpdateRanges(){this.updateRanges.length=0}clone(){return new this.constructor().copy(this)}copy(e){return this.name=e.name,this.source=e.source,this.mipmaps=e.mipmaps.slice(0),this.mapping=e.mapping,this.channel=e.channel,this.wrapS=e.wrapS,this.wrapT=e.wrapT,this.magFilter=e.magFilter,this.minFilter=e.minFilter,this.anisotropy=e.anisotropy,this.format=e.format,this.internalFormat=e.internalFormat,this.type=e.type,this.normalized=e.normalized,this.offset.copy(e.offset),this.repeat.copy(e.repeat),this.center.copy(e.center),this.rotation=e.rotation,this.matrixAutoUpdate=e.matrixAutoUpdate,this.matrix.copy(e.matrix),this.generateMipmaps=e.generateMipmaps,this.mipmapsAutoUpdate=e.mipmapsAutoUpdate,this.premultiplyAlpha=e.premultiplyAlpha,this.flipY=e.flipY,this.unpackAlignment=e.unpackAlignment,this.colorSpace=e.colorSpace,this.renderTarget=e.renderTarget,this.isRenderTargetTexture=e.isRenderTargetTexture,this.isPMREMTexture=e.isPMREMTexture,this.isArrayTexture=e.isArrayTexture,this.userData=JSON.parse(JSON.stringify(e.userData)),this.needsUpdate=!0,this}setValues(e){for(let t in e){let n=e[t];if(n===void 0){Ce(`Texture.setValues(): parameter '${t}' has value of undefined.`);continue}let i=this[t];if(i===void 0){Ce(`Texture.setValues(): property '${t}' does not exist.`);continue}i&&n&&i.isVector2&&n.isVector2||i&&n&&i.isVector3&&n.isVector3||i&&n&&i.isMatrix3&&n.isMatrix3?i.copy(n):this[t]=n}}toJSON(e){let t=e===void 0||typeof e=="string";if(!t&&e.textures[this.uuid]!==void 0)return e.textures[this.uuid];let n={metadata:{version:4.7,type:"Texture",generator:"Texture.toJSON"},uuid:this.uuid,name:this.name,image:this.source.toJSON(e).uuid,mapping:this.mapping,channel:this.channel,repeat:[this.repeat.x,this.repeat.y],offset:[this.offset.x,this.offset.y],center:[this.center.x,this.center.y],rotation:this.rotation,wrap:[this.wrapS,this.wrapT],format:this.format,internalFormat:this.internalFormat,type:this.type,normalized:this.normalized,colorSpace:this.colorSpace,minFilter:this.minFilter,magFilter:this.magFilter,anisotropy:this.anisotropy,flipY:this.flipY,generateMipmaps:this.generateMipmaps,mipmapsAutoUpdate:this.mipmapsAutoUpdate,premultiplyAlpha:this.premultiplyAlpha,unpackAlignment:this.unpackAlignment};return Object.keys(this.userData).length>0&&(n.userData=this.userData),t||(e.textures[this.uuid]=n),n}dispose(){this.dispatchEvent({type:"dispose"})}transformUv(e){if(this.mapping!==_c)return e;if(e.applyMatrix3(this.matrix),e.x<0||e.x>1)switch(this.wrapS){case _o:e.x=e.x-Math.floor(e.x);break;case bn:e.x=e.x<0?0:1;break;case bo:Math.abs(Math.floor(e.x)%2)===1?e.x=Math.ceil(e.x)-e.x:e.x=e.x-Math.floor(e.x);break}if(e.y<0||e.y>1)switch(this.wrapT){case _o:e.y=e.y-Math.floor(e.y);break;case bn:e.y=e.y<0?0:1;break;case bo:Math.abs(Math.floor(e.y)%2)===1?e.y=Math.ceil(e.y)-e.y:e.y=e.y-Math.floor(e.y);break}return this.flipY&&(e.y=1-e.y),e}set needsUpdate(e){e===!0&&(this.version++,this.source.needsUpdate=!0)}set needsPMREMUpdate(e){e===!0&&this.pmremVersion++}};Vt.DEFAULT_IMAGE=null;Vt.DEFAULT_MAPPING=_c;Vt.DEFAULT_ANISOTROPY=1;var at=class{static{this.prototype.isVector4=!0}constructor(e=0,t=0,n=0,i=1){this.x=e,this.y=t,this.z=n,this.w=i}get width(){return this.z}set width(e){this.z=e}get height(){return this.w}set height(e){this.w=e}set(e,t,n,i){return this.x=e,this.y=t,this.z=n,this.w=i,this}setScalar(e){return this.x=e,this.y=e,this.z=e,this.w=e,this}setX(e){return this.x=e,this}setY(e){return this.y=e,this}setZ(e){return this.z=e,this}setW(e){return this.w=e,this}setComponent(e,t){switch(e){case 0:this.x=t;break;case 1:this.y=t;break;case 2:this.z=t;break;case 3:this.w=t;break;default:throw new Error("THREE.Vector4: index is out of range: "+e)}return this}getComponent(e){switch(e){case 0:return this.x;case 1:return this.y;case 2:return this.z;case 3:return this.w;default:throw new Error("THREE.Vector4: index is out of range: "+e)}}clone(){return new this.constructor(this.x,this.y,this.z,this.w)}copy(e){return this.x=e.x,this.y=e.y,this.z=e.z,this.w=e.w!==void 0?e.w:1,this}add(e){return this.x+=e.x,this.y+=e.y,this.z+=e.z,this.w+=e.w,this}addScalar(e){return this.x+=e,this.y+=e,this.z+=e,this.w+=e,this}addVectors(e,t){return this.x=e.x+t.x,this.y=e.y+t.y,this.z=e.z+t.z,this.w=e.w+t.w,this}addScaledVector(e,t){return this.x+=e.x*t,this.y+=e.y*t,this.z+=e.z*t,this.w+=e.w*t,this}sub(e){return this.x-=e.x,this.y-=e.y,this.z-=e.z,this.w-=e.w,this}subScalar(e){return this.x-=e,this.y-=e,this.z-=e,this.w-=e,this}subVectors(e,t){return this.x=e.x-t.x,this.y=e.y-t.y,this.z=e.z-t.z,this.w=e.w-t.w,this}multiply(e){return this.x*=e.x,this.y*=e.y,this.z*=e.z,this.w*=e.w,this}multiplyScalar(e){return this.x*=e,this.y*=e,this.z*=e,this.w*=e,this}applyMatrix4(e){let t=this.x,n=this.y,i=this.z,r=this.w,o=e.elements;return this.x=o[0]*t+o[4]*n+o[8]*i+o[12]*r,this.y=o[1]*t+o[5]*n+o[9]*i+o[13]*r,this.z=o[2]*t+o[6]*n+o[10]*i+o[14]*r,this.w=o[3]*t+o[7]*n+o[11]*i+o[15]*r,this}divide(e){return this.x/=e.x,this.y/=e.y,this.z/=e.z,this.w/=e.w,this}divideScalar(e){return this.multiplyScalar(1/e)}setAxisAngleFromQuaternion(e){this.w=2*Math.acos(e.w);let t=Math.sqrt(1-e.w*e.w);return t<1e-4?(this.x=1,this.y=0,this.z=0):(this.x=e.x/t,this.y=e.y/t,this.z=e.z/t),this}setAxisAngleFromRotationMatrix(e){let t,n,i,r,l=e.elements,c=l[0],h=l[4],u=l[8],f=l[1],d=l[5],g=l[9],x=l[2],p=l[6],m=l[10];if(Math.abs(h-f)<.01&&Math.abs(u-x)<.01&&Math.abs(g-p)<.01){if(Math.abs(h+f)<.1&&Math.abs(u+x)<.1&&Math.abs(g+p)<.1&&Math.abs(c+d+m-3)<.1)return this.set(1,0,0,0),this;t=Math.PI;let T=(c+1)/2,E=(d+1)/2,M=(m+1)/2,w=(h+f)/4,y=(u+x)/4,S=(g+p)/4;return T>E&&T>M?T<.01?(n=0,i=.707106781,r=.707106781):(n=Math.sqrt(T),i=w/n,r=y/n):E>M?E<.01?(n=.707106781,i=0,r=.707106781):(i=Math.sqrt(E),n=w/i,r=S/i):M<.01?(n=.707106781,i=.707106781,r=0):(r=Math.sqrt(M),n=y/r,i=S/r),this.set(n,i,r,t),this}let b=Math.sqrt((p-g)*(p-g)+(u-x)*(u-x)+(f-h)*(f-h));return Math.abs(b)<.001&&(b=1),this.x=(p-g)/b,this.y=(u-x)/b,this.z=(f-h)/b,this.w=Math.acos((c+d+m-1)/2),this}setFromMatrixPosition(e){let t=e.elements;return this.x=t[12],this.y=t[13],this.z=t[14],this.w=t[15],this}min(e){return this.x=Math.min(this.x,e.x),this.y=Math.min(this.y,e.y),this.z=Math.min(this.z,e.z),this.w=Math.min(this.w,e.w),this}max(e){return this.x=Math.max(this.x,e.x),this.y=Math.max(this.y,e.y),this.z=Math.max(this.z,e.z),this.w=Math.max(this.w,e.w),this}clamp(e,t){return this.x=qe(this.x,e.x,t.x),this.y=qe(this.y,e.y,t.y),this.z=qe(this.z,e.z,t.z),this.w=qe(this.w,e.w,t.w),this}clampScalar(e,t){return this.x=qe(this.x,e,t),this.y=qe(this.y,e,t),this.z=qe(this.z,e,t),this.w=qe(this.w,e,t),this}clampLength(e,t){let n=this.length();return this.divideScalar(n||1).multiplyScalar(qe(n,e,t))}floor(){return this.x=Math.floor(this.x),this.y=Math.floor(this.y),this.z=Math.floor(this.z),this.w=Math.floor(this.w),this}ceil(){return this.x=Math.ceil(this.x),this.y=Math.ceil(this.y),this.z=Math.ceil(this.z),this.w=Math.ceil(this.w),this}round(){return this.x=Math.round(this.x),this.y=Math.round(this.y),this.z=Math.round(this.z),this.w=Math.round(this.w),this}roundToZero(){return this.x=Math.trunc(this.x),this.y=Math.trunc(this.y),this.z=Math.trunc(this.z),this.w=Math.trunc(this.w),this}negate(){return this.x=-this.x,this.y=-this.y,this.z=-this.z,this.w=-this.w,this}dot(e){return this.x*e.x+this.y*e.y+this.z*e.z+this.w*e.w}lengthSq(){return this.x*this.x+this.y*this.y+this.z*this.z+this.w*this.w}length(){return Math.sqrt(this.x*this.x+this.y*this.y+this.z*this.z+this.w*this.w)}manhattanLength(){return Math.abs(this.x)+Math.abs(this.y)+Math.abs(this.z)+Math.abs(this.w)}normalize(){return this.divideScalar(this.length()||1)}setLength(e){return this.normalize().multiplyScalar(e)}lerp(e,t){return this.x+=(e.x-this.x)*t,this.y+=(e.y-this.y)*t,this.z+=(e.z-this.z)*t,this.w+=(e.w-this.w)*t,this}lerpVectors(e,t,n){return this.x=e.x+(t.x-e.x)*n,this.y=e.y+(t.y-e.y)*n,this.z=e.z+(t.z-e.z)*n,this.w=e.w+(t.w-e.w)*n,this}equals(e){return e.x===this.x&&e.y===this.y&&e.z===this.z&&e.w===this.w}fromArray(e,t=0){return this.x=e[t],this.y=e[t+1],this.z=e[t+2],this.w=e[t+3],this}toArray(e=[],t=0){return e[t]=this.x,e[t+1]=this.y,e[t+2]=this.z,e[t+3]=this.w,e}fromBufferAttribute(e,t){return this.x=e.getX(t),this.y=e.getY(t),this.z=e.getZ(t),this.w=e.getW(t),this}random(){return this.x=Math.random(),this.y=Math.random(),this.z=Math.random(),this.w=Math.random(),this}*[Symbol.iterator](){yield this.x,yield this.y,yield this.z,yield this.w}},Eo=class extends Mn{constructor(e=1,t=1,n={}){super(),n=Object.assign({generateMipmaps:!1,internalFormat:null,minFilter:kt,depthBuffer:!0,stencilBuffer:!1,resolveColorBuffer:!0,resolveDepthBuffer:!0,resolveStencilBuffer:!0,storeMultisampledColorBuffer:!0,storeMultisampledDepthBuffer:!0,storeMultisampledStencilBuffer:!0,depthTexture:null,samples:0,count:1,depth:1,multiview:!1,useArrayDepthTexture:!1},n),this.isRenderTarget=!0,this.width=e,this.height=t,this.depth=n.depth,this.scissor=new at(0,0,e,t),this.scissorTest=!1,this.viewport=new at(0,0,e,t),this.textures=[];let i=n.count;for(let r=0;r<i;r++)this.textures[r]=new Vt({width:e,height:t,depth:n.depth}),this.textures[r].isRenderTargetTexture=!0,this.textures[r].renderTarget=this;this._setTextureOptions(n),this.depthBuffer=n.depthBuffer,this.stencilBuffer=n.stencilBuffer,this.resolveColorBuffer=n.resolveColorBuffer,this.resolveDepthBuffer=n.resolveDepthBuffer,this.resolveStencilBuffer=n.resolveStencilBuffer,this.storeMultisampledColorBuffer=n.storeMultisampledColorBuffer,this.storeMultisampledDepthBuffer=n.storeMultisampledDepthBuffer,this.storeMultisampledStencilBuffer=n.storeMultisampledStencilBuffer,this._depthTexture=null,this.depthTexture=n.depthTexture,this.samples=n.samples,this.multiview=n.multiview,this.useArrayDepthTexture=n.useArrayDepthTexture}_setTextureOptions(e={}){let t={minFilter:kt,generateMipmaps:!1,flipY:!1,internalFormat:null};e.mapping!==void 0&&(t.mapping=e.mapping),e.wrapS!==void 0&&(t.wrapS=e.wrapS),e.wrapT!==void 0&&(t.wrapT=e.wrapT),e.wrapR!==void 0&&(t.wrapR=e.wrapR),e.magFilter!==void 0&&(t.magFilter=e.magFilter),e.minFilter!==void 0&&(t.minFilter=e.minFilter),e.format!==void 0&&(t.format=e.format),e.type!==void 0&&(t.type=e.type),e.anisotropy!==void 0&&(t.anisotropy=e.anisotropy),e.colorSpace!==void 0&&(t.colorSpace=e.colorSpace),e.flipY!==void 0&&(t.flipY=e.flipY),e.generateMipmaps!==void 0&&(t.generateMipmaps=e.generateMipmaps),e.mipmapsAutoUpdate!==void 0&&(t.mipmapsAutoUpdate=e.mipmapsAutoUpdate),e.internalFormat!==void 0&&(t.internalFormat=e.internalFormat);for(let n=0;n<this.textures.length;n++)this.textures[n].setValues(t)}get texture(){return this.textures[0]}set texture(e){this.textures[0]=e}set depthTexture(e){this._depthTexture!==null&&this._depthTexture.renderTarget===this&&(this._depthTexture.renderTarget=null),e!==null&&e.renderTarget===null&&(e.renderTarget=this),this._depthTexture=e}get depthTexture(){return this._depthTexture}setSize(e,t,n=1){if(this.width!==e||this.height!==t||this.depth!==n){this.width=e,this.height=t,this.depth=n;for(let i=0,r=this.textures.length;i<r;i++)this.textures[i].image.width=e,this.textures[i].image.height=t,this.textures[i].image.depth=n,this.textures[i].isData3DTexture!==!0&&(this.textures[i].isArrayTexture=this.textures[i].image.depth>1);this.dispose()}this.viewport.set(0,0,e,t),this.scissor.set(0,0,e,t)}clone(){return new this.constructor().copy(this)}copy(e){this.width=e.width,this.height=e.height,this.depth=e.depth,this.scissor.copy(e.scissor),this.scissorTest=e.scissorTest,this.viewport.copy(e.viewport),this.textures.length=0;for(let t=0,n=e.textures.length;t<n;t++){this.textures[t]=e.textures[t].clone(),this.textures[t].isRenderTargetTexture=!0,this.textures[t].renderTarget=this;let i=Object.assign({},e.textures[t].image);this.textures[t].source=new Ki(i)}if(this.depthBuffer=e.depthBuffer,this.stencilBuffer=e.stencilBuffer,this.resolveColorBuffer=e.resolveColorBuffer,this.resolveDepthBuffer=e.resolveDepthBuffer,this.resolveStencilBuffer=e.resolveStencilBuffer,this.storeMultisampledColorBuffer=e.storeMultisampledColorBuffer,this.storeMultisampledDepthBuffer=e.storeMultisampledDepthBuffer,this.storeMultisampledStencilBuffer=e.storeMultisampledStencilBuffer,e.depthTexture!==null)if(e.depthTexture.renderTarget===e){let t=e.depthTexture.clone();t.renderTarget=null,this.depthTexture=t}else this.depthTexture=e.depthTexture;else this.depthTexture=null;return this.samples=e.samples,this.multiview=e.multiview,this.useArrayDepthTexture=e.useArrayDepthTexture,this}dispose(){this.dispatchEvent({type:"dispose"})}},$t=class extends Eo{constructor(e=1,t=1,n={}){super(e,t,n),this.isWebGLRenderTarget=!0}},Is=class extends Vt{constructor(e=null,t=1,n=1,i=1){super(null),this.isDataArrayTexture=!0,this.image={data:e,width:t,height:n,depth:i},this.magFilter=wt,this.minFilter=wt,this.wrapR=bn,this.generateMipmaps=!1,this.flipY=!1,this.unpackAlignment=1,this.layerUpdates=new Set}copy(e){return super.copy(e),this.wrapR=e.wrapR,this}addLayerUpdate(e){this.layerUpdates.add(e)}clearLayerUpdates(){this.layerUpdates.clear()}};var Ao=class extends Vt{constructor(e=null,t=1,n=1,i=1){super(null),this.isData3DTexture=!0,this.image={data:e,width:t,height:n,depth:i},this.magFilter=wt,this.minFilter=wt,this.wrapR=bn,this.generateMipmaps=!1,this.flipY=!1,this.unpackAlignment=1}copy(e){return super.copy(e),this.wrapR=e.wrapR,this}};var je=class s{static{this.prototype.isMatrix4=!0}constructor(e,t,n,i,r,o,a,l,c,h,u,f,d,g,x,p){this.elements=[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1],e!==void 0&&this.set(e,t,n,i,r,o,a,l,c,h,u,f,d,g,x,p)}set(e,t,n,i,r,o,a,l,c,h,u,f,d,g,x,p){let m=this.elements;return m[0]=e,m[4]=t,m[8]=n,m[12]=i,m[1]=r,m[5]=o,m[9]=a,m[13]=l,m[2]=c,m[6]=h,m[10]=u,m[14]=f,m[3]=d,m[7]=g,m[11]=x,m[15]=p,this}identity(){return this.set(1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1),this}clone(){return new s().fromArray(this.elements)}copy(e){let t=this.elements,n=e.elements;return t[0]=n[0],t[1]=n[1],t[2]=n[2],t[3]=n[3],t[4]=n[4],t[5]=n[5],t[6]=n[6],t[7]=n[7],t[8]=n[8],t[9]=n[9],t[10]=n[10],t[11]=n[11],t[12]=n[12],t[13]=n[13],t[14]=n[14],t[15]=n[15],this}copyPosition(e){let t=this.elements,n=e.elements;return t[12]=n[12],t[13]=n[13],t[14]=n[14],this}setFromMatrix3(e){let t=e.elements;return this.set(t[0],t[3],t[6],0,t[1],t[4],t[7],0,t[2],t[5],t[8],0,0,0,0,1),this}extractBasis(e,t,n){return this.determinantAffine()===0?(e.set(1,0,0),t.set(0,1,0),n.set(0,0,1),this):(e.setFromMatrixColumn(this,0),t.setFromMatrixColumn(this,1),n.setFromMatrixColumn(this,2),this)}makeBasis(e,t,n){return this.set(e.x,t.x,n.x,0,e.y,t.y,n.y,0,e.z,t.z,n.z,0,0,0,0,1),this}extractRotation(e){if(e.determinantAffine()===0)return this.identity();let t=this.elements,n=e.elements,i=1/Fi.setFromMatrixColumn(e,0).length(),r=1/Fi.setFromMatrixColumn(e,1).length(),o=1/Fi.setFromMatrixColumn(e,2).length();return t[0]=n[0]*i,t[1]=n[1]*i,t[2]=n[2]*i,t[3]=0,t[4]=n[4]*r,t[5]=n[5]*r,t[6]=n[6]*r,t[7]=0,t[8]=n[8]*o,t[9]=n[9]*o,t[10]=n[10]*o,t[11]=0,t[12]=0,t[13]=0,t[14]=0,t[15]=1,this}makeRotationFromEuler(e){let t=this.elements,n=e.x,i=e.y,r=e.z,o=Math.cos(n),a=Math.sin(n),l=Math.cos(i),c=Math.sin(i),h=Math.cos(r),u=Math.sin(r);if(e.order==="XYZ"){let f=o*h,d=o*u,g=a*h,x=a*u;t[0]=l*h,t[4]=-l*u,t[8]=c,t[1]=d+g*c,t[5]=f-x*c,t[9]=-a*l,t[2]=x-f*c,t[6]=g+d*c,t[10]=o*l}else if(e.order==="YXZ"){let f=l*h,d=l*u,g=c*h,x=c*u;t[0]=f+x*a,t[4]=g*a-d,t[8]=o*c,t[1]=o*u,t[5]=o*h,t[9]=-a,t[2]=d*a-g,t[6]=x+f*a,t[10]=o*l}else if(e.order==="ZXY"){let f=l*h,d=l*u,g=c*h,x=c*u;t[0]=f-x*a,t[4]=-o*u,t[8]=g+d*a,t[1]=d+g*a,t[5]=o*h,t[9]=x-f*a,t[2]=-o*c,t[6]=a,t[10]=o*l}else if(e.order==="ZYX"){let f=o*h,d=o*u,g=a*h,x=a*u;t[0]=l*h,t[4]=g*c-d,t[8]=f*c+x,t[1]=l*u,t[5]=x*c+f,t[9]=d*c-g,t[2]=-c,t[6]=a*l,t[10]=o*l}else if(e.order==="YZX"){let f=o*l,d=o*c,g=a*l,x=a*c;t[0]=l*h,t[4]=x-f*u,t[8]=g*u+d,t[1]=u,t[5]=o*h,t[9]=-a*h,t[2]=-c*h,t[6]=d*u+g,t[10]=f-x*u}else if(e.order==="XZY"){let f=o*l,d=o*c,g=a*l,x=a*c;t[0]=l*h,t[4]=-u,t[8]=c*h,t[1]=f*u+x,t[5]=o*h,t[9]=d*u-g,t[2]=g*u-d,t[6]=a*h,t[10]=x*u+f}return t[3]=0,t[7]=0,t[11]=0,t[12]=0,t[13]=0,t[14]=0,t[15]=1,this}makeRotationFromQuaternion(e){return this.compose(op,e,ap)}lookAt(e,t,n){let i=this.elements;return Xt.subVectors(e,t),Xt.lengthSq()===0&&(Xt.z=1),Xt.normalize(),Jn.crossVectors(n,Xt),Jn.lengthSq()===0&&(Math.abs(n.z)===1?Xt.x+=1e-4:Xt.z+=1e-4,Xt.normalize(),Jn.crossVectors(n,Xt)),Jn.normalize(),Br.crossVectors(Xt,Jn),i[0]=Jn.x,i[4]=Br.x,i[8]=Xt.x,i[1]=Jn.y,i[5]=Br.y,i[9]=Xt.y,i[2]=Jn.z,i[6]=Br.z,i[10]=Xt.z,this}multiply(e){return this.multiplyMatrices(this,e)}premultiply(e){return this.multiplyMatrices(e,this)}multiplyMatrices(e,t){let n=e.elements,i=t.elements,r=this.elements,o=n[0],a=n[4],l=n[8],c=n[12],h=n[1],u=n[5],f=n[9],d=n[13],g=n[2],x=n[6],p=n[10],m=n[14],b=n[3],T=n[7],E=n[11],M=n[15],w=i[0],y=i[4],S=i[8],I=i[12],R=i[1],N=i[5],O=i[9],D=i[13],P=i[2],V=i[6],W=i[10],G=i[14],ee=i[3],X=i[7],Q=i[11],te=i[15];return r[0]=o*w+a*R+l*P+c*ee,r[4]=o*y+a*N+l*V+c*X,r[8]=o*S+a*O+l*W+c*Q,r[12]=o*I+a*D+l*G+c*te,r[1]=h*w+u*R+f*P+d*ee,r[5]=h*y+u*N+f*V+d*X,r[9]=h*S+u*O+f*W+d*Q,r[13]=h*I+u*D+f*G+d*te,r[2]=g*w+x*R+p*P+m*ee,r[6]=g*y+x*N+p*V+m*X,r[10]=g*S+x*O+p*W+m*Q,r[14]=g*I+x*D+p*G+m*te,r[3]=b*w+T*R+E*P+M*ee,r[7]=b*y+T*N+E*V+M*X,r[11]=b*S+T*O+E*W+M*Q,r[15]=b*I+T*D+E*G+M*te,this}multiplyScalar(e){let t=this.elements;return t[0]*=e,t[4]*=e,t[8]*=e,t[12]*=e,t[1]*=e,t[5]*=e,t[9]*=e,t[13]*=e,t[2]*=e,t[6]*=e,t[10]*=e,t[14]*=e,t[3]*=e,t[7]*=e,t[11]*=e,t[15]*=e,this}determinant(){let e=this.elements,t=e[0],n=e[4],i=e[8],r=e[12],o=e[1],a=e[5],l=e[9],c=e[13],h=e[2],u=e[6],f=e[10],d=e[14],g=e[3],x=e[7],p=e[11],m=e[15],b=l*d-c*f,T=a*d-c*u,E=a*f-l*u,M=o*d-c*h,w=o*f-l*h,y=o*u-a*h;return t*(x*b-p*T+m*E)-n*(g*b-p*M+m*w)+i*(g*T-x*M+m*y)-r*(g*E-x*w+p*y)}determinantAffine(){let e=this.elements,t=e[0],n=e[4],i=e[8],r=e[1],o=e[5],a=e[9],l=e[2],c=e[6],h=e[10];return t*(o*h-a*c)-n*(r*h-a*l)+i*(r*c-o*l)}transpose(){let e=this.elements,t;return t=e[1],e[1]=e[4],e[4]=t,t=e[2],e[2]=e[8],e[8]=t,t=e[6],e[6]=e[9],e[9]=t,t=e[3],e[3]=e[12],e[12]=t,t=e[7],e[7]=e[13],e[13]=t,t=e[11],e[11]=e[14],e[14]=t,this}setPosition(e,t,n){let i=this.elements;return e.isVector3?(i[12]=e.x,i[13]=e.y,i[14]=e.z):(i[12]=e,i[13]=t,i[14]=n),this}invert(){let e=this.elements,t=e[0],n=e[1],i=e[2],r=e[3],o=e[4],a=e[5],l=e[6],c=e[7],h=e[8],u=e[9],f=e[10],d=e[11],g=e[12],x=e[13],p=e[14],m=e[15],b=t*a-n*o,T=t*l-i*o,E=t*c-r*o,M=n*l-i*a,w=n*c-r*a,y=i*c-r*l,S=h*x-u*g,I=h*p-f*g,R=h*m-d*g,N=u*p-f*x,O=u*m-d*x,D=f*m-d*p,P=b*D-T*O+E*N+M*R-w*I+y*S;if(P===0)return this.set(0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0);let V=1/P;return e[0]=(a*D-l*O+c*N)*V,e[1]=(i*O-n*D-r*N)*V,e[2]=(x*y-p*w+m*M)*V,e[3]=(f*w-u*y-d*M)*V,e[4]=(l*R-o*D-c*I)*V,e[5]=(t*D-i*R+r*I)*V,e[6]=(p*E-g*y-m*T)*V,e[7]=(h*y-f*E+d*T)*V,e[8]=(o*O-a*R+c*S)*V,e[9]=(n*R-t*O-r*S)*V,e[10]=(g*w-x*E+m*b)*V,e[11]=(u*E-h*w-d*b)*V,e[12]=(a*I-o*N-l*S)*V,e[13]=(t*N-n*I+i*S)*V,e[14]=(x*T-g*M-p*b)*V,e[15]=(h*M-u*T+f*b)*V,this}scale(e){let t=this.elements,n=e.x,i=e.y,r=e.z;return t[0]*=n,t[4]*=i,t[8]*=r,t[1]*=n,t[5]*=i,t[9]*=r,t[2]*=n,t[6]*=i,t[10]*=r,t[3]*=n,t[7]*=i,t[11]*=r,this}getMaxScaleOnAxis(){let e=this.elements,t=e[0]*e[0]+e[1]*e[1]+e[2]*e[2],n=e[4]*e[4]+e[5]*e[5]+e[6]*e[6],i=e[8]*e[8]+e[9]*e[9]+e[10]*e[10];return Math.sqrt(Math.max(t,n,i))}makeTranslation(e,t,n){return e.isVector3?this.set(1,0,0,e.x,0,1,0,e.y,0,0,1,e.z,0,0,0,1):this.set(1,0,0,e,0,1,0,t,0,0,1,n,0,0,0,1),this}makeRotationX(e){let t=Math.cos(e),n=Math.sin(e);return this.set(1,0,0,0,0,t,-n,0,0,n,t,0,0,0,0,1),this}makeRotationY(e){let t=Math.cos(e),n=Math.sin(e);return this.set(t,0,n,0,0,1,0,0,-n,0,t,0,0,0,0,1),this}makeRotationZ(e){let t=Math.cos(e),n=Math.sin(e);return this.set(t,-n,0,0,n,t,0,0,0,0,1,0,0,0,0,1),this}makeRotationAxis(e,t){let n=Math.cos(t),i=Math.sin(t),r=1-n,o=e.x,a=e.y,l=e.z,c=r*o,h=r*a;return this.set(c*o+n,c*a-i*l,c*l+i*a,0,c*a+i*l,h*a+n,h*l-i*o,0,c*l-i*a,h*l+i*o,r*l*l+n,0,0,0,0,1),this}makeScale(e,t,n){return this.set(e,0,0,0,0,t,0,0,0,0,n,0,0,0,0,1),this}makeShear(e,t,n,i,r,o){return this.set(1,n,r,0,e,1,o,0,t,i,1,0,0,0,0,1),this}compose(e,t,n){let i=this.elements,r=t._x,o=t._y,a=t._z,l=t._w,c=r+r,h=o+o,u=a+a,f=r*c,d=r*h,g=r*u,x=o*h,p=o*u,m=a*u,b=l*c,T=l*h,E=l*u,M=n.x,w=n.y,y=n.z;return i[0]=(1-(x+m))*M,i[1]=(d+E)*M,i[2]=(g-T)*M,i[3]=0,i[4]=(d-E)*w,i[5]=(1-(f+m))*w,i[6]=(p+b)*w,i[7]=0,i[8]=(g+T)*y,i[9]=(p-b)*y,i[10]=(1-(f+x))*y,i[11]=0,i[12]=e.x,i[13]=e.y,i[14]=e.z,i[15]=1,this}decompose(e,t,n){let i=this.elements;e.x=i[12],e.y=i[13],e.z=i[14];let r=this.determinantAffine();if(r===0)return n.set(1,1,1),t.identity(),this;let o=Fi.set(i[0],i[1],i[2]).length(),a=Fi.set(i[4],i[5],i[6]).length(),l=Fi.set(i[8],i[9],i[10]).length();r<0&&(o=-o),ln.copy(this);let c=1/o,h=1/a,u=1/l;return ln.elements[0]*=c,ln.elements[1]*=c,ln.elements[2]*=c,ln.elements[4]*=h,ln.elements[5]*=h,ln.elements[6]*=h,ln.elements[8]*=u,ln.elements[9]*=u,ln.elements[10]*=u,t.setFromRotationMatrix(ln),n.x=o,n.y=a,n.z=l,this}makePerspective(e,t,n,i,r,o,a=tn,l=!1){let c=this.elements,h=2*r/(t-e),u=2*r/(n-i),f=(t+e)/(t-e),d=(n+i)/(n-i),g,x;if(l)g=r/(o-r),x=o*r/(o-r);else if(a===tn)g=-(o+r)/(o-r),x=-2*o*r/(o-r);else if(a===Zi)g=-o/(o-r),x=-o*r/(o-r);else throw new Error("THREE.Matrix4.makePerspective(): Invalid coordinate system: "+a);return c[0]=h,c[4]=0,c[8]=f,c[12]=0,c[1]=0,c[5]=u,c[9]=d,c[13]=0,c[2]=0,c[6]=0,c[10]=g,c[14]=x,c[3]=0,c[7]=0,c[11]=-1,c[15]=0,this}makeOrthographic(e,t,n,i,r,o,a=tn,l=!1){let c=this.elements,h=2/(t-e),u=2/(n-i),f=-(t+e)/(t-e),d=-(n+i)/(n-i),g,x;if(l)g=1/(o-r),x=o/(o-r);else if(a===tn)g=-2/(o-r),x=-(o+r)/(o-r);else if(a===Zi)g=-1/(o-r),x=-r/(o-r);else throw new Error("THREE.Matrix4.makeOrthographic(): Invalid coordinate system: "+a);return c[0]=h,c[4]=0,c[8]=0,c[12]=f,c[1]=0,c[5]=u,c[9]=0,c[13]=d,c[2]=0,c[6]=0,c[10]=g,c[14]=x,c[3]=0,c[7]=0,c[11]=0,c[15]=1,this}equals(e){let t=this.elements,n=e.elements;for(let i=0;i<16;i++)if(t[i]!==n[i])return!1;return!0}fromArray(e,t=0){for(let n=0;n<16;n++)this.elements[n]=e[n+t];return this}toArray(e=[],t=0){let n=this.elements;return e[t]=n[0],e[t+1]=n[1],e[t+2]=n[2],e[t+3]=n[3],e[t+4]=n[4],e[t+5]=n[5],e[t+6]=n[6],e[t+7]=n[7],e[t+8]=n[8],e[t+9]=n[9],e[t+10]=n[10],e[t+11]=n[11],e[t+12]=n[12],e[t+13]=n[13],e[t+14]=n[14],e[t+15]=n[15],e}},Fi=new U,ln=new je,op=new U(0,0,0),ap=new U(1,1,1),Jn=new U,Br=new U,Xt=new U,Gh=new je,Hh=new nn,On=class s{constructor(e=0,t=0,n=0,i=s.DEFAULT_ORDER){this.isEuler=!0,this._x=e,this._y=t,this._z=n,this._order=i}get x(){return this._x}set x(e){this._x=e,this._onChangeCallback()}get y(){return this._y}set y(e){this._y=e,this._onChangeCallback()}get z(){return this._z}set z(e){this._z=e,this._onChangeCallback()}get order(){return this._order}set order(e){this._order=e,this._onChangeCallback()}set(e,t,n,i=this._order){return this._x=e,this._y=t,this._z=n,this._order=i,this._onChangeCallback(),this}clone(){return new this.constructor(this._x,this._y,this._z,this._order)}copy(e){return this._x=e._x,this._y=e._y,this._z=e._z,this._order=e._order,this._onChangeCallback(),this}setFromRotationMatrix(e,t=this._order,n=!0){let i=e.elements,r=i[0],o=i[4],a=i[8],l=i[1],c=i[5],h=i[9],u=i[2],f=i[6],d=i[10];switch(t){case"XYZ":this._y=Math.asin(qe(a,-1,1)),Math.abs(a)<.9999999?(this._x=Math.atan2(-h,d),this._z=Math.atan2(-o,r)):(this._x=Math.atan2(f,c),this._z=0);break;case"YXZ":this._x=Math.asin(-qe(h,-1,1)),Math.abs(h)<.9999999?(this._y=Math.atan2(a,d),this._z=Math.atan2(l,c)):(this._y=Math.atan2(-u,r),this._z=0);break;case"ZXY":this._x=Math.asin(qe(f,-1,1)),Math.abs(f)<.9999999?(this._y=Math.atan2(-u,d),this._z=Math.atan2(-o,c)):(this._y=0,this._z=Math.atan2(l,r));break;case"ZYX":this._y=Math.asin(-qe(u,-1,1)),Math.abs(u)<.9999999?(this._x=Math.atan2(f,d),this._z=Math.atan2(l,r)):(this._x=0,this._z=Math.atan2(-o,c));break;case"YZX":this._z=Math.asin(qe(l,-1,1)),Math.abs(l)<.9999999?(this._x=Math.atan2(-h,c),this._y=Math.atan2(-u,r)):(this._x=0,this._y=Math.atan2(a,d));break;case"XZY":this._z=Math.asin(-qe(o,-1,1)),Math.abs(o)<.9999999?(this._x=Math.atan2(f,c),this._y=Math.atan2(a,r)):(this._x=Math.atan2(-h,d),this._y=0);break;default:Ce("Euler: .setFromRotationMatrix() encountered an unknown order: "+t)}return this._order=t,n===!0&&this._onChangeCallback(),this}setFromQuaternion(e,t,n){return Gh.makeRotationFromQuaternion(e),this.setFromRotationMatrix(Gh,t,n)}setFromVector3(e,t=this._order){return this.set(e.x,e.y,e.z,t)}reorder(e){return Hh.setFromEuler(this),this.setFromQuaternion(Hh,e)}equals(e){return e._x===this._x&&e._y===this._y&&e._z===this._z&&e._order===this._order}fromArray(e){return this._x=e[0],this._y=e[1],this._z=e[2],e[3]!==void 0&&(this._order=e[3]),this._onChangeCallback(),this}toArray(e=[],t=0){return e[t]=this._x,e[t+1]=this._y,e[t+2]=this._z,e[t+3]=this._order,e}_onChange(e){return this._onChangeCallback=e,this}_onChangeCallback(){}*[Symbol.iterator](){yield this._x,yield this._y,yield this._z,yield this._order}};On.DEFAULT_ORDER="XYZ";var Ls=class{constructor(){this.mask=1}set(e){this.mask=(1<<e|0)>>>0}enable(e){this.mask|=1<<e|0}enableAll(){this.mask=-1}toggle(e){this.mask^=1<<e|0}disable(e){this.mask&=~(1<<e|0)}disableAll(){this.mask=0}test(e){return(this.mask&e.mask)!==0}isEnabled(e){return(this.mask&(1<<e|0))!==0}},lp=0,Wh=new U,Ui=new nn,Rn=new je,kr=new U,bs=new U,cp=new U,hp=new nn,Xh=new U(1,0,0),qh=new U(0,1,0),Yh=new U(0,0,1),$h={type:"added"},up={type:"removed"},Oi={type:"childadded",child:null},Ul={type:"childremoved",child:null},Rt=class s extends Mn{constructor(){super(),this.isObject3D=!0,Object.defineProperty(this,"id",{value:lp++}),this.uuid=rr(),this.name="",this.type="Object3D",this.parent=null,this.children=[],this.up=s.DEFAULT_UP.clone();let e=new U,t=new On,n=new nn,i=new U(1,1,1);function r(){n.setFromEuler(t,!1)}function o(){t.setFromQuaternion(n,void 0,!1)}t._onChange(r),n._onChange(o),Object.defineProperties(this,{position:{configurable:!0,enumerable:!0,value:e},rotation:{configurable:!0,enumerable:!0,value:t},quaternion:{configurable:!0,enumerable:!0,value:n},scale:{configurable:!0,enumerable:!0,value:i},modelViewMatrix:{value:new je},normalMatrix:{value:new Ne}}),this.matrix=new je,this.matrixWorld=new je,this.matrixAutoUpdate=s.DEFAULT_MATRIX_AUTO_UPDATE,this.matrixWorldAutoUpdate=s.DEFAULT_MATRIX_WORLD_AUTO_UPDATE,this.matrixWorldNeedsUpdate=!1,this.layers=new Ls,this.visible=!0,this.castShadow=!1,this.receiveShadow=!1,this.frustumCulled=!0,this.renderOrder=0,this.animations=[],this.customDepthMaterial=void 0,this.customDistanceMaterial=void 0,this.static=!1,this.userData={},this.pivot=null}onBeforeShadow(){}onAfterShadow(){}onBeforeRender(){}onAfterRender(){}applyMatrix4(e){this.matrixAutoUpdate&&this.updateMatrix(),this.matrix.premultiply(e),this.matrix.decompose(this.position,this.quaternion,this.scale),this.pivot!==null&&this.position.copy(this.pivot).applyMatrix4(this.matrix).sub(this.pivot)}applyQuaternion(e){return this.quaternion.premultiply(e),this}setRotationFromAxisAngle(e,t){this.quaternion.setFromAxisAngle(e,t)}setRotationFromEuler(e){this.quaternion.setFromEuler(e,!0)}setRotationFromMatrix(e){this.quaternion.setFromRotationMatrix(e)}setRotationFromQuaternion(e){this.quaternion.copy(e)}rotateOnAxis(e,t){return Ui.setFromAxisAngle(e,t),this.quaternion.multiply(Ui),this}rotateOnWorldAxis(e,t){return Ui.setFromAxisAngle(e,t),this.quaternion.premultiply(Ui),this}rotateX(e){return this.rotateOnAxis(Xh,e)}rotateY(e){return this.rotateOnAxis(qh,e)}rotateZ(e){return this.rotateOnAxis(Yh,e)}translateOnAxis(e,t){return Wh.copy(e).applyQuaternion(this.quaternion),this.position.add(Wh.multiplyScalar(t)),this}translateX(e){return this.translateOnAxis(Xh,e)}translateY(e){return this.translateOnAxis(qh,e)}translateZ(e){return this.translateOnAxis(Yh,e)}localToWorld(e){return this.updateWorldMatrix(!0,!1),e.applyMatrix4(this.matrixWorld)}worldToLocal(e){return this.updateWorldMatrix(!0,!1),e.applyMatrix4(Rn.copy(this.matrixWorld).invert())}lookAt(e,t,n){e.isVector3?kr.copy(e):kr.set(e,t,n);let i=this.parent;this.updateWorldMatrix(!0,!1),bs.setFromMatrixPosition(this.matrixWorld),this.isCamera||this.isLight?Rn.lookAt(bs,kr,this.up):Rn.lookAt(kr,bs,this.up),this.quaternion.setFromRotationMatrix(Rn),i&&(Rn.extractRotation(i.matrixWorld),Ui.setFromRotationMatrix(Rn),this.quaternion.premultiply(Ui.invert()))}add(e){if(arguments.length>1){for(let t=0;t<arguments.length;t++)this.add(arguments[t]);return this}return e===this?(Le("Object3D.add: object can't be added as a child of itself.",e),this):(e&&e.isObject3D?(e.removeFromParent(),e.parent=this,this.children.push(e),e.dispatchEvent($h),Oi.child=e,this.dispatchEvent(Oi),Oi.child=null):Le("Object3D.add: object not an instance of THREE.Object3D.",e),this)}remove(e){if(arguments.length>1){for(let n=0;n<arguments.length;n++)this.remove(arguments[n]);return this}let t=this.children.indexOf(e);return t!==-1&&(e.parent=null,this.children.splice(t,1),e.dispatchEvent(up),Ul.child=e,this.dispatchEvent(Ul),Ul.child=null),this}removeFromParent(){let e=this.parent;return e!==null&&e.remove(this),this}clear(){return this.remove(...this.children)}attach(e){return this.updateWorldMatrix(!0,!1),Rn.copy(this.matrixWorld).invert(),e.parent!==null&&(e.parent.updateWorldMatrix(!0,!1),Rn.multiply(e.parent.matrixWorld)),e.applyMatrix4(Rn),e.removeFromParent(),e.parent=this,this.children.push(e),e.updateWorldMatrix(!1,!0),e.dispatchEvent($h),Oi.child=e,this.dispatchEvent(Oi),Oi.child=null,this}getObjectById(e){return this.getObjectByProperty("id",e)}getObjectByName(e){return this.getObjectByProperty("name",e)}getObjectByProperty(e,t){if(this[e]===t)return this;for(let n=0,i=this.children.length;n<i;n++){let o=this.children[n].getObjectByProperty(e,t);if(o!==void 0)return o}}getObjectsByProperty(e,t,n=[]){this[e]===t&&n.push(this);let i=this.children;for(let r=0,o=i.length;r<o;r++)i[r].getObjectsByProperty(e,t,n);return n}getWorldPosition(e){return this.updateWorldMatrix(!0,!1),e.setFromMatrixPosition(this.matrixWorld)}getWorldQuaternion(e){return this.updateWorldMatrix(!0,!1),this.matrixWorld.decompose(bs,e,cp),e}getWorldScale(e){return this.updateWorldMatrix(!0,!1),this.matrixWorld.decompose(bs,hp,e),e}getWorldDirection(e){this.updateWorldMatrix(!0,!1);let t=this.matrixWorld.elements;return e.set(t[8],t[9],t[10]).normalize()}raycast(){}intersectsFrustum(){return!0}traverse(e){e(this);let t=this.children;for(let n=0,i=t.length;n<i;n++)t[n].traverse(e)}traverseVisible(e){if(this.visible===!1)return;e(this);let t=this.children;for(let n=0,i=t.length;n<i;n++)t[n].traverseVisible(e)}traverseAncestors(e){let t=this.parent;t!==null&&(e(t),t.traverseAncestors(e))}updateMatrix(){this.matrix.compose(this.position,this.quaternion,this.scale);let e=this.pivot;if(e!==null){let t=e.x,n=e.y,i=e.z,r=this.matrix.elements;r[12]+=t-r[0]*t-r[4]*n-r[8]*i,r[13]+=n-r[1]*t-r[5]*n-r[9]*i,r[14]+=i-r[2]*t-r[6]*n-r[10]*i}this.matrixWorldNeedsUpdate=!0}updateMatrixWorld(e){this.matrixAutoUpdate&&this.updateMatrix(),(this.matrixWorldNeedsUpdate||e)&&(this.matrixWorldAutoUpdate===!0&&(this.parent===null?this.matrixWorld.copy(this.matrix):this.matrixWorld.multiplyMatrices(this.parent.matrixWorld,this.matrix)),this.matrixWorldNeedsUpdate=!1,e=!0);let t=this.children;for(let n=0,i=t.length;n<i;n++)t[n].updateMatrixWorld(e)}updateWorldMatrix(e,t,n=!1){let i=this.parent;if(e===!0&&i!==null&&i.updateWorldMatrix(!0,!1),this.matrixAutoUpdate&&this.updateMatrix(),(this.matrixWorldNeedsUpdate||n)&&(this.matrixWorldAutoUpdate===!0&&(this.parent===null?this.matrixWorld.copy(this.matrix):this.matrixWorld.multiplyMatrices(this.parent.matrixWorld,this.matrix)),this.matrixWorldNeedsUpdate=!1,n=!0),t===!0){let r=this.children;for(let o=0,a=r.length;o<a;o++)r[o].updateWorldMatrix(!1,!0,n)}}toJSON(e){let t=e===void 0||typeof e=="string",n={};t&&(e={geometries:{},materials:{},textures:{},images:{},shapes:{},skeletons:{},animations:{},nodes:{}},n.metadata={version:4.7,type:"Object",generator:"Object3D.toJSON"});let i={};i.uuid=this.uuid,i.type=this.type,i.name=this.name,i.castShadow=this.castShadow,i.receiveShadow=this.receiveShadow,i.visible=this.visible,i.frustumCulled=this.frustumCulled,i.renderOrder=this.renderOrder,i.static=this.static,i.matrixAutoUpdate=this.matrixAutoUpdate,Object.keys(this.userData).length>0&&(i.userData=this.userData),i.layers=this.layers.mask,i.matrix=this.matrix.toArray(),i.up=this.up.toArray(),this.pivot!==null&&(i.pivot=this.pivot.toArray()),this.morphTargetDictionary!==void 0&&(i.morphTargetDictionary=Object.assign({},this.morphTargetDictionary)),this.morphTargetInfluences!==void 0&&(i.morphTargetInfluences=this.morphTargetInfluences.slice()),this.isInstancedMesh&&(i.type="InstancedMesh",i.count=this.count,i.instanceMatrix=this.instanceMatrix.toJSON(),this.instanceColor!==null&&(i.instanceColor=this.instanceColor.toJSON())),this.isBatchedMesh&&(i.type="BatchedMesh",i.perObjectFrustumCulled=this.perObjectFrustumCulled,i.sortObjects=this.sortObjects,i.drawRanges=this._drawRanges,i.reservedRanges=this._reservedRanges,i.geometryInfo=this._geometryInfo.map(a=>({...a,boundingBox:a.boundingBox?a.boundingBox.toJSON():void 0,boundingSphere:a.boundingSphere?a.boundingSphere.toJSON():void 0})),i.instanceInfo=this._instanceInfo.map(a=>({...a})),i.availableInstanceIds=this._availableInstanceIds.slice(),i.availableGeometryIds=this._availableGeometryIds.slice(),i.nextIndexStart=this._nextIndexStart,i.nextVertexStart=this._nextVertexStart,i.geometryCount=this._geometryCount,i.maxInstanceCount=this._maxInstanceCount,i.maxVertexCount=this._maxVertexCount,i.maxIndexCount=this._maxIndexCount,i.geometryInitialized=this._geometryInitialized,i.matricesTexture=this._matricesTexture.toJSON(e),i.indirectTexture=this._indirectTexture.toJSON(e),this._colorsTexture!==null&&(i.colorsTexture=this._colorsTexture.toJSON(e)),this.boundingSphere!==null&&(i.boundingSphere=this.boundingSphere.toJSON()),this.boundingBox!==null&&(i.boundingBox=this.boundingBox.toJSON()));function r(a,l){return a[l.uuid]===void 0&&(a[l.uuid]=l.toJSON(e)),l.uuid}if(this.isScene)this.background&&(this.background.isColor?i.background=this.background.toJSON():this.background.isTexture&&(i.background=this.background.toJSON(e).uuid)),this.environment&&this.environment.isTexture&&this.environment.isRenderTargetTexture!==!0&&(i.environment=this.environment.toJSON(e).uuid);else if(this.isMesh||this.isLine||this.isPoints){i.geometry=r(e.geometries,this.geometry);let a=this.geometry.parameters;if(a!==void 0&&a.shapes!==void 0){let l=a.shapes;if(Array.isArray(l))for(let c=0,h=l.length;c<h;c++){let u=l[c];r(e.shapes,u)}else r(e.shapes,l)}}if(this.isSkinnedMesh&&(i.bindMode=this.bindMode,i.bindMatrix=this.bindMatrix.toArray(),this.skeleton!==void 0&&(r(e.skeletons,this.skeleton),i.skeleton=this.skeleton.uuid)),this.material!==void 0)if(Array.isArray(this.material)){let a=[];for(let l=0,c=this.material.length;l<c;l++)a.push(r(e.materials,this.material[l]));i.material=a}else i.material=r(e.materials,this.material);if(this.children.length>0){i.children=[];for(let a=0;a<this.children.length;a++)i.children.push(this.children[a].toJSON(e).object)}if(this.animations.length>0){i.animations=[];for(let a=0;a<this.animations.length;a++){let l=this.animations[a];i.animations.push(r(e.animations,l))}}if(t){let a=o(e.geometries),l=o(e.materials),c=o(e.textures),h=o(e.images),u=o(e.shapes),f=o(e.skeletons),d=o(e.animations),g=o(e.nodes);a.length>0&&(n.geometries=a),l.length>0&&(n.materials=l),c.length>0&&(n.textures=c),h.length>0&&(n.images=h),u.length>0&&(n.shapes=u),f.length>0&&(n.skeletons=f),d.length>0&&(n.animations=d),g.length>0&&(n.nodes=g)}return n.object=i,n;function o(a){let l=[];for(let c in a){let h=a[c];delete h.metadata,l.push(h)}return l}}clone(e){return new this.constructor().copy(this,e)}copy(e,t=!0){if(this.name=e.name,this.up.copy(e.up),this.position.copy(e.position),this.rotation.order=e.rotation.order,this.quaternion.copy(e.quaternion),this.scale.copy(e.scale),this.pivot=e.pivot!==null?e.pivot.clone():null,this.matrix.copy(e.matrix),this.matrixWorld.copy(e.matrixWorld),this.matrixAutoUpdate=e.matrixAutoUpdate,this.matrixWorldAutoUpdate=e.matrixWorldAutoUpdate,this.matrixWorldNeedsUpdate=e.matrixWorldNeedsUpdate,this.layers.mask=e.layers.mask,this.visible=e.visible,this.castShadow=e.castShadow,this.receiveShadow=e.receiveShadow,this.frustumCulled=e.frustumCulled,this.renderOrder=e.renderOrder,this.static=e.static,this.animations=e.animations.slice(),this.userData=JSON.parse(JSON.stringify(e.userData)),t===!0)for(let n=0;n<e.children.length;n++){let i=e.children[n];this.add(i.clone())}return this}dispose(){this.dispatchEvent({type:"dispose"})}};Rt.DEFAULT_UP=new U(0,1,0);Rt.DEFAULT_MATRIX_AUTO_UPDATE=!0;Rt.DEFAULT_MATRIX_WORLD_AUTO_UPDATE=!0;var Dn=class extends Rt{constructor(){super(),this.isGroup=!0,this.type="Group"}},dp={type:"move"},ji=class{constructor(){this._targetRay=null,this._grip=null,this._hand=null}getHandSpace(){return this._hand===null&&(this._hand=new Dn,this._hand.matrixAutoUpdate=!1,this._hand.visible=!1,this._hand.joints={},this._hand.inputState={pinching:!1}),this._hand}getTargetRaySpace(){return this._targetRay===null&&(this._targetRay=new Dn,this._targetRay.matrixAutoUpdate=!1,this._targetRay.visible=!1,this._targetRay.hasLinearVelocity=!1,this._targetRay.linearVelocity=new U,this._targetRay.hasAngularVelocity=!1,this._targetRay.angularVelocity=new U),this._targetRay}getGripSpace(){return this._grip===null&&(this._grip=new Dn,this._grip.matrixAutoUpdate=!1,this._grip.visible=!1,this._grip.hasLinearVelocity=!1,this._grip.linearVelocity=new U,this._grip.hasAngularVelocity=!1,this._grip.angularVelocity=new U,this._grip.eventsEnabled=!1),this._grip}dispatchEvent(e){return this._targetRay!==null&&this._targetRay.dispatchEvent(e),this._grip!==null&&this._grip.dispatchEvent(e),this._hand!==null&&this._hand.dispatchEvent(e),this}connect(e){if(e&&e.hand){let t=this._hand;if(t)for(let n of e.hand.values())this._getHandJoint(t,n)}return this.dispatchEvent({type:"connected",data:e}),this}disconnect(e){return this.dispatchEvent({type:"disconnected",data:e}),this._targetRay!==null&&(this._targetRay.visible=!1),this._grip!==null&&(this._grip.visible=!1),this._hand!==null&&(this._hand.visible=!1),this}update(e,t,n){let i=null,r=null,o=null,a=this._targetRay,l=this._grip,c=this._hand;if(e&&t.session.visibilityState!=="visible-blurred"){if(c&&e.hand){o=!0;for(let x of e.hand.values()){let p=t.getJointPose(x,n),m=this._getHandJoint(c,x);p!==null&&(m.matrix.fromArray(p.transform.matrix),m.matrix.decompose(m.position,m.quaternion,m.scale),m.matrixWorldNeedsUpdate=!0,m.jointRadius=p.radius),m.visible=p!==null}let h=c.joints["index-finger-tip"],u=c.joints["thumb-tip"],f=h.position.distanceTo(u.position),d=.02,g=.005;c.inputState.pinching&&f>d+g?(c.inputState.pinching=!1,this.dispatchEvent({type:"pinchend",handedness:e.handedness,target:this})):!c.inputState.pinching&&f<=d-g&&(c.inputState.pinching=!0,this.dispatchEvent({type:"pinchstart",handedness:e.handedness,target:this}))}else l!==null&&e.gripSpace&&(r=t.getPose(e.gripSpace,n),r!==null&&(l.matrix.fromArray(r.transform.matrix),l.matrix.decompose(l.position,l.quaternion,l.scale),l.matrixWorldNeedsUpdate=!0,r.linearVelocity?(l.hasLinearVelocity=!0,l.linearVelocity.copy(r.linearVelocity)):l.hasLinearVelocity=!1,r.angularVelocity?(l.hasAngularVelocity=!0,l.angularVelocity.copy(r.angularVelocity)):l.hasAngularVelocity=!1,l.eventsEnabled&&l.dispatchEvent({type:"gripUpdated",data:e,target:this})));a!==null&&(i=t.getPose(e.targetRaySpace,n),i===null&&r!==null&&(i=r),i!==null&&(a.matrix.fromArray(i.transform.matrix),a.matrix.decompose(a.position,a.quaternion,a.scale),a.matrixWorldNeedsUpdate=!0,i.linearVelocity?(a.hasLinearVelocity=!0,a.linearVelocity.copy(i.linearVelocity)):a.hasLinearVelocity=!1,i.angularVelocity?(a.hasAngularVelocity=!0,a.angularVelocity.copy(i.angularVelocity)):a.hasAngularVelocity=!1,this.dispatchEvent(dp)))}return a!==null&&(a.visible=i!==null),l!==null&&(l.visible=r!==null),c!==null&&(c.visible=o!==null),this}_getHandJoint(e,t){if(e.joints[t.jointName]===void 0){let n=new Dn;n.matrixAutoUpdate=!1,n.visible=!1,e.joints[t.jointName]=n,e.add(n)}return e.joints[t.jointName]}},Zu={aliceblue:15792383,antiquewhite:16444375,aqua:65535,aquamarine:8388564,azure:15794175,beige:16119260,bisque:16770244,black:0,blanchedalmond:16772045,blue:255,blueviolet:9055202,brown:10824234,burlywood:14596231,cadetblue:6266528,chartreuse:8388352,chocolate:13789470,coral:16744272,cornflowerblue:6591981,cornsilk:16775388,crimson:14423100,cyan:65535,darkblue:139,darkcyan:35723,darkgoldenrod:12092939,darkgray:11119017,darkgreen:25600,darkgrey:11119017,darkkhaki:12433259,darkmagenta:9109643,darkolivegreen:5597999,darkorange:16747520,darkorchid:10040012,darkred:9109504,darksalmon:15308410,darkseagreen:9419919,darkslateblue:4734347,darkslategray:3100495,darkslategrey:3100495,darkturquoise:52945,darkviolet:9699539,deeppink:16716947,deepskyblue:49151,dimgray:6908265,dimgrey:6908265,dodgerblue:2003199,firebrick:11674146,floralwhite:16775920,forestgreen:2263842,fuchsia:16711935,gainsboro:14474460,ghostwhite:16316671,gold:16766720,goldenrod:14329120,gray:8421504,green:32768,greenyellow:11403055,grey:8421504,honeydew:15794160,hotpink:16738740,indianred:13458524,indigo:4915330,ivory:16777200,khaki:15787660,lavender:15132410,lavenderblush:16773365,lawngreen:8190976,lemonchiffon:16775885,lightblue:11393254,lightcoral:15761536,lightcyan:14745599,lightgoldenrodyellow:16448210,lightgray:13882323,lightgreen:9498256,lightgrey:13882323,lightpink:16758465,lightsalmon:16752762,lightseagreen:2142890,lightskyblue:8900346,lightslategray:7833753,lightslategrey:7833753,lightsteelblue:11584734,lightyellow:16777184,lime:65280,limegreen:3329330,linen:16445670,magenta:16711935,maroon:8388608,mediumaquamarine:6737322,mediumblue:205,mediumorchid:12211667,mediumpurple:9662683,mediumseagreen:3978097,mediumslateblue:8087790,mediumspringgreen:64154,mediumturquoise:4772300,mediumvioletred:13047173,midnightblue:1644912,mintcream:16121850,mistyrose:16770273,moccasin:16770229,navajowhite:16768685,navy:128,oldlace:16643558,olive:8421376,olivedrab:7048739,orange:16753920,orangered:16729344,orchid:14315734,palegoldenrod:15657130,palegreen:10025880,paleturquoise:11529966,palevioletred:14381203,papayawhip:16773077,peachpuff:16767673,peru:13468991,pink:16761035,plum:14524637,powderblue:11591910,purple:8388736,rebeccapurple:6697881,red:16711680,rosybrown:12357519,royalblue:4286945,saddlebrown:9127187,salmon:16416882,sandybrown:16032864,seagreen:3050327,seashell:16774638,sienna:10506797,silver:12632256,skyblue:8900331,slateblue:6970061,slategray:7372944,slategrey:7372944,snow:16775930,springgreen:65407,steelblue:4620980,tan:13808780,teal:32896,thistle:14204888,tomato:16737095,turquoise:4251856,violet:15631086,wheat:16113331,white:16777215,whitesmoke:16119285,yellow:16776960,yellowgreen:10145074},Kn={h:0,s:0,l:0},zr={h:0,s:0,l:0};function Ol(s,e,t){return t<0&&(t+=1),t>1&&(t-=1),t<1/6?s+(e-s)*6*t:t<1/2?e:t<2/3?s+(e-s)*6*(2/3-t):s}var Ie=class{constructor(e,t,n){return this.isColor=!0,this.r=1,this.g=1,this.b=1,this.set(e,t,n)}set(e,t,n){if(t===void 0&&n===void 0){let i=e;i&&i.isColor?this.copy(i):typeof i=="number"?this.setHex(i):typeof i=="string"&&this.setStyle(i)}else this.setRGB(e,t,n);return this}setScalar(e){return this.r=e,this.g=e,this.b=e,this}setHex(e,t=Yt){return e=Math.floor(e),this.r=(e>>16&255)/255,this.g=(e>>8&255)/255,this.b=(e&255)/255,Xe.colorSpaceToWorking(this,t),this}setRGB(e,t,n,i=Xe.workingColorSpace){return this.r=e,this.g=t,this.b=n,Xe.colorSpaceToWorking(this,i),this}setHSL(e,t,n,i=Xe.workingColorSpace){if(e=ep(e,1),t=qe(t,0,1),n=qe(n,0,1),t===0)this.r=this.g=this.b=n;else{let r=n<=.5?n*(1+t):n+t-n*t,o=2*n-r;this.r=Ol(o,r,e+1/3),this.g=Ol(o,r,e),this.b=Ol(o,r,e-1/3)}return Xe.colorSpaceToWorking(this,i),this}setStyle(e,t=Yt){function n(r){r!==void 0&&parseFloat(r)<1&&Ce("Color: Alpha component of "+e+" will be ignored.")}let i;if(i=/^(\w+)\(([^\)]*)\)/.exec(e)){let r,o=i[1],a=i[2];switch(o){case"rgb":case"rgba":if(r=/^\s*(\d+)\s*,\s*(\d+)\s*,\s*(\d+)\s*(?:,\s*(\d+(?:\.\d+)?|\.\d+)\s*)?$/.exec(a))return n(r[4]),this.setRGB(Math.min(255,parseInt(r[1],10))/255,Math.min(255,parseInt(r[2],10))/255,Math.min(255,parseInt(r[3],10))/255,t);if(r=/^\s*(\d+(?:\.\d+)?|\.\d+)\%\s*,\s*(\d+(?:\.\d+)?|\.\d+)\%\s*,\s*(\d+(?:\.\d+)?|\.\d+)\%\s*(?:,\s*(\d+(?:\.\d+)?|\.\d+)\s*)?$/.exec(a))return n(r[4]),this.setRGB(Math.min(100,parseFloat(r[1]))/100,Math.min(100,parseFloat(r[2]))/100,Math.min(100,parseFloat(r[3]))/100,t);break;case"hsl":case"hsla":if(r=/^\s*([+-]?(?:\d+(?:\.\d+)?|\.\d+))\s*,\s*(\d+(?:\.\d+)?|\.\d+)\%\s*,\s*(\d+(?:\.\d+)?|\.\d+)\%\s*(?:,\s*(\d+(?:\.\d+)?|\.\d+)\s*)?$/.exec(a))return n(r[4]),this.setHSL(parseFloat(r[1])/360,parseFloat(r[2])/100,parseFloat(r[3])/100,t);break;default:Ce("Color: Unknown color model "+e)}}else if(i=/^\#([A-Fa-f\d]+)$/.exec(e)){let r=i[1],o=r.length;if(o===3)return this.setRGB(parseInt(r.charAt(0),16)/15,parseInt(r.charAt(1),16)/15,parseInt(r.charAt(2),16)/15,t);if(o===6)return this.setHex(parseInt(r,16),t);Ce("Color: Invalid hex color "+e)}else if(e&&e.length>0)return this.setColorName(e,t);return this}setColorName(e,t=Yt){let n=Zu[e.toLowerCase()];return n!==void 0?this.setHex(n,t):Ce("Color: Unknown color "+e),this}clone(){return new this.constructor(this.r,this.g,this.b)}copy(e){return this.r=e.r,this.g=e.g,this.b=e.b,this}copySRGBToLinear(e){return this.r=Fn(e.r),this.g=Fn(e.g),this.b=Fn(e.b),this}copyLinearToSRGB(e){return this.r=Yi(e.r),this.g=Yi(e.g),this.b=Yi(e.b),this}convertSRGBToLinear(){return this.copySRGBToLinear(this),this}convertLinearToSRGB(){return this.copyLinearToSRGB(this),this}getHex(e=Yt){return Xe.workingToColorSpace(Nt.copy(this),e),Math.round(qe(Nt.r*255,0,255))*65536+Math.round(qe(Nt.g*255,0,255))*256+Math.round(qe(Nt.b*255,0,255))}getHexString(e=Yt){return("000000"+this.getHex(e).toString(16)).slice(-6)}getHSL(e,t=Xe.workingColorSpace){Xe.workingToColorSpace(Nt.copy(this),t);let n=Nt.r,i=Nt.g,r=Nt.b,o=Math.max(n,i,r),a=Math.min(n,i,r),l,c,h=(a+o)/2;if(a===o)l=0,c=0;else{let u=o-a;switch(c=h<=.5?u/(o+a):u/(2-o-a),o){case n:l=(i-r)/u+(i<r?6:0);break;case i:l=(r-n)/u+2;break;case r:l=(n-i)/u+4;break}l/=6}return e.h=l,e.s=c,e.l=h,e}getRGB(e,t=Xe.workingColorSpace){return Xe.workingToColorSpace(Nt.copy(this),t),e.r=Nt.r,e.g=Nt.g,e.b=Nt.b,e}getStyle(e=Yt){Xe.workingToColorSpace(Nt.copy(this),e);let t=Nt.r,n=Nt.g,i=Nt.b;return e!==Yt?`color(${e} ${t.toFixed(3)} ${n.toFixed(3)} ${i.toFixed(3)})`:`rgb(${Math.round(t*255)},${Math.round(n*255)},${Math.round(i*255)})`}offsetHSL(e,t,n){return this.getHSL(Kn),this.setHSL(Kn.h+e,Kn.s+t,Kn.l+n)}add(e){return this.r+=e.r,this.g+=e.g,this.b+=e.b,this}addColors(e,t){return this.r=e.r+t.r,this.g=e.g+t.g,this.b=e.b+t.b,this}addScalar(e){return this.r+=e,this.g+=e,this.b+=e,this}sub(e){return this.r=Math.max(0,this.r-e.r),this.g=Math.max(0,this.g-e.g),this.b=Math.max(0,this.b-e.b),this}multiply(e){return this.r*=e.r,this.g*=e.g,this.b*=e.b,this}multiplyScalar(e){return this.r*=e,this.g*=e,this.b*=e,this}lerp(e,t){return this.r+=(e.r-this.r)*t,this.g+=(e.g-this.g)*t,this.b+=(e.b-this.b)*t,this}lerpColors(e,t,n){return this.r=e.r+(t.r-e.r)*n,this.g=e.g+(t.g-e.g)*n,this.b=e.b+(t.b-e.b)*n,this}lerpHSL(e,t){this.getHSL(Kn),e.getHSL(zr);let n=Il(Kn.h,zr.h,t),i=Il(Kn.s,zr.s,t),r=Il(Kn.l,zr.l,t);return this.setHSL(n,i,r),this}setFromVector3(e){return this.r=e.x,this.g=e.y,this.b=e.z,this}applyMatrix3(e){let t=this.r,n=this.g,i=this.b,r=e.elements;return this.r=r[0]*t+r[3]*n+r[6]*i,this.g=r[1]*t+r[4]*n+r[7]*i,this.b=r[2]*t+r[5]*n+r[8]*i,this}equals(e){return e.r===this.r&&e.g===this.g&&e.b===this.b}fromArray(e,t=0){return this.r=e[t],this.g=e[t+1],this.b=e[t+2],this}toArray(e=[],t=0){return e[t]=this.r,e[t+1]=this.g,e[t+2]=this.b,e}fromBufferAttribute(e,t){return this.r=e.getX(t),this.g=e.getY(t),this.b=e.getZ(t),this}toJSON(){return this.getHex()}*[Symbol.iterator](){yield this.r,yield this.g,yield this.b}},Nt=new Ie;Ie.NAMES=Zu;var Ns=class extends Rt{constructor(){super(),this.isScene=!0,this.type="Scene",this.background=null,this.environment=null,this.fog=null,this.backgroundBlurriness=0,this.backgroundIntensity=1,this.backgroundRotation=new On,this.environmentIntensity=1,this.environmentRotation=new On,this.overrideMaterial=null,typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("observe",{detail:this}))}copy(e,t){return super.copy(e,t),this.background=e.background!==null?e.background.clone():null,this.environment=e.environment!==null?e.environment.clone():null,this.fog=e.fog!==null?e.fog.clone():null,this.backgroundBlurriness=e.backgroundBlurriness,this.backgroundIntensity=e.backgroundIntensity,this.backgroundRotation.copy(e.backgroundRotation),this.environmentIntensity=e.environmentIntensity,this.environmentRotation.copy(e.environmentRotation),this.overrideMaterial=e.overrideMaterial!==null?e.overrideMaterial.clone():null,this.matrixAutoUpdate=e.matrixAutoUpdate,this}toJSON(e){let t=super.toJSON(e);return this.fog!==null&&(t.object.fog=this.fog.toJSON()),t.object.backgroundBlurriness=this.backgroundBlurriness,t.object.backgroundIntensity=this.backgroundIntensity,t.object.backgroundRotation=this.backgroundRotation.toArray(),t.object.environmentIntensity=this.environmentIntensity,t.object.environmentRotation=this.environmentRotation.toArray(),t}},cn=new U,Cn=new U,Bl=new U,Pn=new U,Bi=new U,ki=new U,Zh=new U,kl=new U,zl=new U,Vl=new U,Gl=new at,Hl=new at,Wl=new at,Nn=class s{constructor(e=new U,t=new U,n=new U){this.a=e,this.b=t,this.c=n}static getNormal(e,t,n,i){i.subVectors(n,t),cn.subVectors(e,t),i.cross(cn);let r=i.lengthSq();return r>0?i.multiplyScalar(1/Math.sqrt(r)):i.set(0,0,0)}static getBarycoord(e,t,n,i,r){cn.subVectors(i,t),Cn.subVectors(n,t),Bl.subVectors(e,t);let o=cn.dot(cn),a=cn.dot(Cn),l=cn.dot(Bl),c=Cn.dot(Cn),h=Cn.dot(Bl),u=o*c-a*a;if(u===0)return r.set(0,0,0),null;let f=1/u,d=(c*l-a*h)*f,g=(o*h-a*l)*f;return r.set(1-d-g,g,d)}static containsPoint(e,t,n,i){return this.getBarycoord(e,t,n,i,Pn)===null?!1:Pn.x>=0&&Pn.y>=0&&Pn.x+Pn.y<=1}static getInterpolation(e,t,n,i,r,o,a,l){return this.getBarycoord(e,t,n,i,Pn)===null?(l.x=0,l.y=0,"z"in l&&(l.z=0),"w"in l&&(l.w=0),null):(l.setScalar(0),l.addScaledVector(r,Pn.x),l.addScaledVector(o,Pn.y),l.addScaledVector(a,Pn.z),l)}static getInterpolatedAttribute(e,t,n,i,r,o){return Gl.setScalar(0),Hl.setScalar(0),Wl.setScalar(0),Gl.fromBufferAttribute(e,t),Hl.fromBufferAttribute(e,n),Wl.fromBufferAttribute(e,i),o.setScalar(0),o.addScaledVector(Gl,r.x),o.addScaledVector(Hl,r.y),o.addScaledVector(Wl,r.z),o}static isFrontFacing(e,t,n,i){return cn.subVectors(n,t),Cn.subVectors(e,t),cn.cross(Cn).dot(i)<0}set(e,t,n){return this.a.copy(e),this.b.copy(t),this.c.copy(n),this}setFromPointsAndIndices(e,t,n,i){return this.a.copy(e[t]),this.b.copy(e[n]),this.c.copy(e[i]),this}setFromAttributeAndIndices(e,t,n,i){return this.a.fromBufferAttribute(e,t),this.b.fromBufferAttribute(e,n),this.c.fromBufferAttribute(e,i),this}clone(){return new this.constructor().copy(this)}copy(e){return this.a.copy(e.a),this.b.copy(e.b),this.c.copy(e.c),this}getArea(){return cn.subVectors(this.c,this.b),Cn.subVectors(this.a,this.b),cn.cross(Cn).length()*.5}getMidpoint(e){return e.addVectors(this.a,this.b).add(this.c).multiplyScalar(1/3)}getNormal(e){return s.getNormal(this.a,this.b,this.c,e)}getPlane(e){return e.setFromCoplanarPoints(this.a,this.b,this.c)}getBarycoord(e,t){return s.getBarycoord(e,this.a,this.b,this.c,t)}getInterpolation(e,t,n,i,r){return s.getInterpolation(e,this.a,this.b,this.c,t,n,i,r)}containsPoint(e){return s.containsPoint(e,this.a,this.b,this.c)}isFrontFacing(e){return s.isFrontFacing(this.a,this.b,this.c,e)}intersectsBox(e){return e.intersectsTriangle(this)}closestPointToPoint(e,t){let n=this.a,i=this.b,r=this.c,o,a;Bi.subVectors(i,n),ki.subVectors(r,n),kl.subVectors(e,n);let l=Bi.dot(kl),c=ki.dot(kl);if(l<=0&&c<=0)return t.copy(n);zl.subVectors(e,i);let h=Bi.dot(zl),u=ki.dot(zl);if(h>=0&&u<=h)return t.copy(i);let f=l*u-h*c;if(f<=0&&l>=0&&h<=0&&l-h>0)return o=l/(l-h),t.copy(n).addScaledVector(Bi,o);Vl.subVectors(e,r);let d=Bi.dot(Vl),g=ki.dot(Vl);if(g>=0&&d<=g)return t.copy(r);let x=d*c-l*g;if(x<=0&&c>=0&&g<=0)return a=c/(c-g),t.copy(n).addScaledVector(ki,a);let p=h*g-d*u;if(p<=0&&u-h>=0&&d-g>=0)return Zh.subVectors(r,i),a=(u-h)/(u-h+(d-g)),t.copy(i).addScaledVector(Zh,a);let m=1/(p+x+f);return o=x*m,a=f*m,t.copy(n).addScaledVector(Bi,o).addScaledVector(ki,a)}equals(e){return e.a.equals(this.a)&&e.b.equals(this.b)&&e.c.equals(this.c)}},ti=class{constructor(e=new U(1/0,1/0,1/0),t=new U(-1/0,-1/0,-1/0)){this.isBox3=!0,this.min=e,this.max=t}set(e,t){return this.min.copy(e),this.max.copy(t),this}setFromArray(e){this.makeEmpty();for(let t=0,n=e.length;t<n;t+=3)this.expandByPoint(hn.fromArray(e,t));return this}setFromBufferAttribute(e){this.makeEmpty();for(let t=0,n=e.count;t<n;t++)this.expandByPoint(hn.fromBufferAttribute(e,t));return this}setFromPoints(e){this.makeEmpty();for(let t=0,n=e.length;t<n;t++)this.expandByPoint(e[t]);return this}setFromCenterAndSize(e,t){let n=hn.copy(t).multiplyScalar(.5);return this.min.copy(e).sub(n),this.max.copy(e).add(n),this}setFromObject(e,t=!1){return this.makeEmpty(),this.expandByObject(e,t)}clone(){return new this.constructor().copy(this)}copy(e){return this.min.copy(e.min),this.max.copy(e.max),this}makeEmpty(){return this.min.x=this.min.y=this.min.z=1/0,this.max.x=this.max.y=this.max.z=-1/0,this}isEmpty(){return this.max.x<this.min.x||this.max.y<this.min.y||this.max.z<this.min.z}getCenter(e){return this.isEmpty()?e.set(0,0,0):e.addVectors(this.min,this.max).multiplyScalar(.5)}getSize(e){return this.isEmpty()?e.set(0,0,0):e.subVectors(this.max,this.min)}expandByPoint(e){return this.min.min(e),this.max.max(e),this}expandByVector(e){return this.min.sub(e),this.max.add(e),this}expandByScalar(e){return this.min.addScalar(-e),this.max.addScalar(e),this}expandByObject(e,t=!1){e.updateWorldMatrix(!1,!1);let n=e.geometry;if(n!==void 0){let r=n.getAttribute("position");if(t===!0&&r!==void 0&&e.isInstancedMesh!==!0&&e.isBatchedMesh!==!0)for(let o=0,a=r.count;o<a;o++)e.isMesh===!0?e.getVertexPosition(o,hn):hn.fromBufferAttribute(r,o),hn.applyMatrix4(e.matrixWorld),this.expandByPoint(hn);else e.boundingBox!==void 0?(e.boundingBox===null&&e.computeBoundingBox(),Vr.copy(e.boundingBox)):(n.boundingBox===null&&n.computeBoundingBox(),Vr.copy(n.boundingBox)),Vr.applyMatrix4(e.matrixWorld),this.union(Vr)}let i=e.children;for(let r=0,o=i.length;r<o;r++)this.expandByObject(i[r],t);return this}containsPoint(e){return e.x>=this.min.x&&e.x<=this.max.x&&e.y>=this.min.y&&e.y<=this.max.y&&e.z>=this.min.z&&e.z<=this.max.z}containsBox(e){return this.min.x<=e.min.x&&e.max.x<=this.max.x&&this.min.y<=e.min.y&&e.max.y<=this.max.y&&this.min.z<=e.min.z&&e.max.z<=this.max.z}getParameter(e,t){return t.set((e.x-this.min.x)/(this.max.x-this.min.x),(e.y-this.min.y)/(this.max.y-this.min.y),(e.z-this.min.z)/(this.max.z-this.min.z))}intersectsBox(e){return e.max.x>=this.min.x&&e.min.x<=this.max.x&&e.max.y>=this.min.y&&e.min.y<=this.max.y&&e.max.z>=this.min.z&&e.min.z<=this.max.z}intersectsSphere(e){return this.clampPoint(e.center,hn),hn.distanceToSquared(e.center)<=e.radius*e.radius}intersectsPlane(e){let t,n;return e.normal.x>0?(t=e.normal.x*this.min.x,n=e.normal.x*this.max.x):(t=e.normal.x*this.max.x,n=e.normal.x*this.min.x),e.normal.y>0?(t+=e.normal.y*this.min.y,n+=e.normal.y*this.max.y):(t+=e.normal.y*this.max.y,n+=e.normal.y*this.min.y),e.normal.z>0?(t+=e.normal.z*this.min.z,n+=e.normal.z*this.max.z):(t+=e.normal.z*this.max.z,n+=e.normal.z*this.min.z),t<=-e.constant&&n>=-e.constant}intersectsTriangle(e){if(this.isEmpty())return!1;this.getCenter(Ms),Gr.subVectors(this.max,Ms),zi.subVectors(e.a,Ms),Vi.subVectors(e.b,Ms),Gi.subVectors(e.c,Ms),jn.subVectors(Vi,zi),Qn.subVectors(Gi,Vi),mi.subVectors(zi,Gi);let t=[0,-jn.z,jn.y,0,-Qn.z,Qn.y,0,-mi.z,mi.y,jn.z,0,-jn.x,Qn.z,0,-Qn.x,mi.z,0,-mi.x,-jn.y,jn.x,0,-Qn.y,Qn.x,0,-mi.y,mi.x,0];return!Xl(t,zi,Vi,Gi,Gr)||(t=[1,0,0,0,1,0,0,0,1],!Xl(t,zi,Vi,Gi,Gr))?!1:(Hr.crossVectors(jn,Qn),t=[Hr.x,Hr.y,Hr.z],Xl(t,zi,Vi,Gi,Gr))}clampPoint(e,t){return t.copy(e).clamp(this.min,this.max)}distanceToPoint(e){return this.clampPoint(e,hn).distanceTo(e)}getBoundingSphere(e){return this.isEmpty()?e.makeEmpty():(this.getCenter(e.center),e.radius=this.getSize(hn).length()*.5),e}intersect(e){return this.min.max(e.min),this.max.min(e.max),this.isEmpty()&&this.makeEmpty(),this}union(e){return this.min.min(e.min),this.max.max(e.max),this}applyMatrix4(e){return this.isEmpty()?this:(In[0].set(this.min.x,this.min.y,this.min.z).applyMatrix4(e),In[1].set(this.min.x,this.min.y,this.max.z).applyMatrix4(e),In[2].set(this.min.x,this.max.y,this.min.z).applyMatrix4(e),In[3].set(this.min.x,this.max.y,this.max.z).applyMatrix4(e),In[4].set(this.max.x,this.min.y,this.min.z).applyMatrix4(e),In[5].set(this.max.x,this.min.y,this.max.z).applyMatrix4(e),In[6].set(this.max.x,this.max.y,this.min.z).applyMatrix4(e),In[7].set(this.max.x,this.max.y,this.max.z).applyMatrix4(e),this.setFromPoints(In),this)}translate(e){return this.min.add(e),this.max.add(e),this}equals(e){return e.min.equals(this.min)&&e.max.equals(this.max)}toJSON(){return{min:this.min.toArray(),max:this.max.toArray()}}fromJSON(e){return this.min.fromArray(e.min),this.max.fromArray(e.max),this}},In=[new U,new U,new U,new U,new U,new U,new U,new U],hn=new U,Vr=new ti,zi=new U,Vi=new U,Gi=new U,jn=new U,Qn=new U,mi=new U,Ms=new U,Gr=new U,Hr=new U,gi=new U;function Xl(s,e,t,n,i){for(let r=0,o=s.length-3;r<=o;r+=3){gi.fromArray(s,r);let a=i.x*Math.abs(gi.x)+i.y*Math.abs(gi.y)+i.z*Math.abs(gi.z),l=e.dot(gi),c=t.dot(gi),h=n.dot(gi);if(Math.max(-Math.max(l,c,h),Math.min(l,c,h))>a)return!1}return!0}var pt=new U,Wr=new Be,fp=0,Bt=class extends Mn{constructor(e,t,n=!1){if(super(),Array.isArray(e))throw new TypeError("THREE.BufferAttribute: array should be a Typed Array.");this.isBufferAttribute=!0,Object.defineProperty(this,"id",{value:fp++}),this.name="",this.array=e,this.itemSize=t,this.count=e!==void 0?e.length/t:0,this.normalized=n,this.usage=Hu,this.updateRanges=[],this.gpuType=fn,this.version=0,this._normalizationScale=e!==void 0?Nc(e):void 0}onUploadCallback(){}set needsUpdate(e){e===!0&&this.version++}setUsage(e){return this.usage=e,this}addUpdateRange(e,t){this.updateRanges.push({start:e,count:t})}clearUpdateRanges(){this.updateRanges.length=0}copy(e){return this.name=e.name,this.array=new e.array.constructor(e.array),this.itemSize=e.itemSize,this.count=e.count,this.normalized=e.normalized,this.usage=e.usage,this.gpuType=e.gpuType,this._normalizationScale=e._normalizationScale,this}copyAt(e,t,n){e*=this.itemSize,n*=t.itemSize;for(let i=0,r=this.itemSize;i<r;i++)this.array[e+i]=t.array[n+i];return this}copyArray(e){return this.array.set(e),this}applyMatrix3(e){if(this.itemSize===2)for(let t=0,n=this.count;t<n;t++)Wr.fromBufferAttribute(this,t),Wr.applyMatrix3(e),this.setXY(t,Wr.x,Wr.y);else if(this.itemSize===3)for(let t=0,n=this.count;t<n;t++)pt.fromBufferAttribute(this,t),pt.applyMatrix3(e),this.setXYZ(t,pt.x,pt.y,pt.z);return this}applyMatrix4(e){for(let t=0,n=this.count;t<n;t++)pt.fromBufferAttribute(this,t),pt.applyMatrix4(e),this.setXYZ(t,pt.x,pt.y,pt.z);return this}applyNormalMatrix(e){for(let t=0,n=this.count;t<n;t++)pt.fromBufferAttribute(this,t),pt.applyNormalMatrix(e),this.setXYZ(t,pt.x,pt.y,pt.z);return this}transformDirection(e){for(let t=0,n=this.count;t<n;t++)pt.fromBufferAttribute(this,t),pt.transformDirection(e),this.setXYZ(t,pt.x,pt.y,pt.z);return this}set(e,t=0){return this.array.set(e,t),this}getComponent(e,t){let n=this.array[e*this.itemSize+t];return this.normalized&&(n=this._denormalize(n)),n}setComponent(e,t,n){return this.normalized&&(n=this._normalize(n)),this.array[e*this.itemSize+t]=n,this}getX(e){let t=this.array[e*this.itemSize];return this.normalized&&(t=this._denormalize(t)),t}setX(e,t){return this.normalized&&(t=this._normalize(t)),this.array[e*this.itemSize]=t,this}getY(e){let t=this.array[e*this.itemSize+1];return this.normalized&&(t=this._denormalize(t)),t}setY(e,t){return this.normalized&&(t=this._normalize(t)),this.array[e*this.itemSize+1]=t,this}getZ(e){let t=this.array[e*this.itemSize+2];return this.normalized&&(t=this._denormalize(t)),t}setZ(e,t){return this.normalized&&(t=this._normalize(t)),this.array[e*this.itemSize+2]=t,this}getW(e){let t=this.array[e*this.itemSize+3];return this.normalized&&(t=this._denormalize(t)),t}setW(e,t){return this.normalized&&(t=this._normalize(t)),this.array[e*this.itemSize+3]=t,this}setXY(e,t,n){return e*=this.itemSize,this.normalized&&(t=this._normalize(t),n=this._normalize(n)),this.array[e+0]=t,this.array[e+1]=n,this}setXYZ(e,t,n,i){return e*=this.itemSize,this.normalized&&(t=this._normalize(t),n=this._normalize(n),i=this._normalize(i)),this.array[e+0]=t,this.array[e+1]=n,this.array[e+2]=i,this}setXYZW(e,t,n,i,r){return e*=this.itemSize,this.normalized&&(t=this._normalize(t),n=this._normalize(n),i=this._normalize(i),r=this._normalize(r)),this.array[e+0]=t,this.array[e+1]=n,this.array[e+2]=i,this.array[e+3]=r,this}onUpload(e){return this.onUploadCallback=e,this}clone(){return new this.constructor(this.array,this.itemSize).copy(this)}toJSON(){let e={itemSize:this.itemSize,type:this.array.constructor.name,array:Array.from(this.array),normalized:this.normalized};return e.name=this.name,e.usage=this.usage,e.gpuType=this.gpuType,e}dispose(){this.dispatchEvent({type:"dispose"})}_denormalize(e){let t=this._normalizationScale;return t!==void 0?Math.max(e/t,-1):tp(e,this.array)}_normalize(e){let t=this._normalizationScale;return t!==void 0?Math.round(e*t):np(e,this.array)}};var Ds=class extends Bt{constructor(e,t,n){super(new Uint16Array(e),t,n)}};var Fs=class extends Bt{constructor(e,t,n){super(new Uint32Array(e),t,n)}};var nt=class extends Bt{constructor(e,t,n){super(new Float32Array(e),t,n)}},pp=new ti,Ss=new U,ql=new U,Bn=class{constructor(e=new U,t=-1){this.isSphere=!0,this.center=e,this.radius=t}set(e,t){return this.center.copy(e),this.radius=t,this}setFromPoints(e,t){let n=this.center;t!==void 0?n.copy(t):pp.setFromPoints(e).getCenter(n);let i=0;for(let r=0,o=e.length;r<o;r++)i=Math.max(i,n.distanceToSquared(e[r]));return this.radius=Math.sqrt(i),this}copy(e){return this.center.copy(e.center),this.radius=e.radius,this}isEmpty(){return this.radius<0}makeEmpty(){return this.center.set(0,0,0),this.radius=-1,this}containsPoint(e){return e.distanceToSquared(this.center)<=this.radius*this.radius}distanceToPoint(e){return e.distanceTo(this.center)-this.radius}intersectsSphere(e){let t=this.radius+e.radius;return e.center.distanceToSquared(this.center)<=t*t}intersectsBox(e){return e.intersectsSphere(this)}intersectsPlane(e){return Math.abs(e.distanceToPoint(this.center))<=this.radius}clampPoint(e,t){let n=this.center.distanceToSquared(e);return t.copy(e),n>this.radius*this.radius&&(t.sub(this.center).normalize(),t.multiplyScalar(this.radius).add(this.center)),t}getBoundingBox(e){return this.isEmpty()?(e.makeEmpty(),e):(e.set(this.center,this.center),e.expandByScalar(this.radius),e)}applyMatrix4(e){return this.center.applyMatrix4(e),this.radius=this.radius*e.getMaxScaleOnAxis(),this}translate(e){return this.center.add(e),this}expandByPoint(e){if(this.isEmpty())return this.center.copy(e),this.radius=0,this;Ss.subVectors(e,this.center);let t=Ss.lengthSq();if(t>this.radius*this.radius){let n=Math.sqrt(t),i=(n-this.radius)*.5;this.center.addScaledVector(Ss,i/n),this.radius+=i}return this}union(e){return e.isEmpty()?this:this.isEmpty()?(this.copy(e),this):(this.center.equals(e.center)===!0?this.radius=Math.max(this.radius,e.radius):(ql.subVectors(e.center,this.center).setLength(e.radius),this.expandByPoint(Ss.copy(e.center).add(ql)),this.expandByPoint(Ss.copy(e.center).sub(ql))),this)}equals(e){return e.center.equals(this.center)&&e.radius===this.radius}clone(){return new this.constructor().copy(this)}toJSON(){return{radius:this.radius,center:this.center.toArray()}}fromJSON(e){return this.radius=e.radius,this.center.fromArray(e.center),this}},mp=0,en=new je,Yl=new Rt,Hi=new U,qt=new ti,ws=new ti,St=new U,Et=class s extends Mn{constructor(){super(),this.isBufferGeometry=!0,Object.defineProperty(this,"id",{value:mp++}),this.uuid=rr(),this.name="",this.type="BufferGeometry",this.index=null,this.indirect=null,this.indirectOffset=0,this.attributes={},this.morphAttributes={},this.morphTargetsRelative=!1,this.groups=[],this.boundingBox=null,this.boundingSphere=null,this.drawRange={start:0,count:1/0},this.userData={},this._transformed=!1}getIndex(){return this.index}setIndex(e){return Array.isArray(e)?this.index=new(jf(e)?Fs:Ds)(e,1):this.index=e,this}setIndirect(e,t=0){return this.indirect=e,this.indirectOffset=t,this}getIndirect(){return this.indirect}getAttribute(e){return this.attributes[e]}setAttribute(e,t){return this.attributes[e]=t,this}deleteAttribute(e){return delete this.attributes[e],this}hasAttribute(e){return this.attributes[e]!==void 0}addGroup(e,t,n=0){this.groups.push({start:e,count:t,materialIndex:n})}clearGroups(){this.groups=[]}setDrawRange(e,t){this.drawRange.start=e,this.drawRange.count=t}applyMatrix4(e){let t=this.attributes.position;t!==void 0&&(t.applyMatrix4(e),t.needsUpdate=!0);let n=this.attributes.normal;if(n!==void 0){let r=new Ne().getNormalMatrix(e);n.applyNormalMatrix(r),n.needsUpdate=!0}let i=this.attributes.tangent;return i!==void 0&&(i.transformDirection(e),i.needsUpdate=!0),this.boundingBox!==null&&this.computeBoundingBox(),this.boundingSphere!==null&&this.computeBoundingSphere(),this._transformed=!0,this}applyQuaternion(e){return en.makeRotationFromQuaternion(e),this.applyMatrix4(en),this}rotateX(e){return en.makeRotationX(e),this.applyMatrix4(en),this}rotateY(e){return en.makeRotationY(e),this.applyMatrix4(en),this}rotateZ(e){return en.makeRotationZ(e),this.applyMatrix4(en),this}translate(e,t,n){return en.makeTranslation(e,t,n),this.applyMatrix4(en),this}scale(e,t,n){return en.makeScale(e,t,n),this.applyMatrix4(en),this}lookAt(e){return Yl.lookAt(e),Yl.updateMatrix(),this.applyMatrix4(Yl.matrix),this}center(){return this.computeBoundingBox(),this.boundingBox.getCenter(Hi).negate(),this.translate(Hi.x,Hi.y,Hi.z),this}setFromPoints(e){let t=this.getAttribute("position");if(t===void 0){let n=[];for(let i=0,r=e.length;i<r;i++){let o=e[i];n.push(o.x,o.y,o.z||0)}this.setAttribute("position",new nt(n,3))}else{let n=Math.min(e.length,t.count);for(let i=0;i<n;i++){let r=e[i];t.setXYZ(i,r.x,r.y,r.z||0)}e.length>t.count&&Ce("BufferGeometry: Buffer size too small for points data. Use .dispose() and create a new geometry."),t.needsUpdate=!0}return this}computeBoundingBox(){this.boundingBox===null&&(this.boundingBox=new ti);let e=this.attributes.position,t=this.morphAttributes.position;if(e&&e.isGLBufferAttribute){Le("BufferGeometry.computeBoundingBox(): GLBufferAttribute requires a manual bounding box.",this),this.boundingBox.set(new U(-1/0,-1/0,-1/0),new U(1/0,1/0,1/0));return}if(e!==void 0){if(this.boundingBox.setFromBufferAttribute(e),t)for(let n=0,i=t.length;n<i;n++){let r=t[n];qt.setFromBufferAttribute(r),this.morphTargetsRelative?(St.addVectors(this.boundingBox.min,qt.min),this.boundingBox.expandByPoint(St),St.addVectors(this.boundingBox.max,qt.max),this.boundingBox.expandByPoint(St)):(this.boundingBox.expandByPoint(qt.min),this.boundingBox.expandByPoint(qt.max))}}else this.boundingBox.makeEmpty();(isNaN(this.boundingBox.min.x)||isNaN(this.boundingBox.min.y)||isNaN(this.boundingBox.min.z))&&Le('BufferGeometry.computeBoundingBox(): Computed min/max have NaN values. The "position" attribute is likely to have NaN values.',this)}computeBoundingSphere(){this.boundingSphere===null&&(this.boundingSphere=new Bn);let e=this.attributes.position,t=this.morphAttributes.position;if(e&&e.isGLBufferAttribute){Le("BufferGeometry.computeBoundingSphere(): GLBufferAttribute requires a manual bounding sphere.",this),this.boundingSphere.set(new U,1/0);return}if(e){let n=this.boundingSphere.center;if(qt.setFromBufferAttribute(e),t)for(let r=0,o=t.length;r<o;r++){let a=t[r];ws.setFromBufferAttribute(a),this.morphTargetsRelative?(St.addVectors(qt.min,ws.min),qt.expandByPoint(St),St.addVectors(qt.max,ws.max),qt.expandByPoint(St)):(qt.expandByPoint(ws.min),qt.expandByPoint(ws.max))}qt.getCenter(n);let i=0;for(let r=0,o=e.count;r<o;r++)St.fromBufferAttribute(e,r),i=Math.max(i,n.distanceToSquared(St));if(t)for(let r=0,o=t.length;r<o;r++){let a=t[r],l=this.morphTargetsRelative;for(let c=0,h=a.count;c<h;c++)St.fromBufferAttribute(a,c),l&&(Hi.fromBufferAttribute(e,c),St.add(Hi)),i=Math.max(i,n.distanceToSquared(St))}this.boundingSphere.radius=Math.sqrt(i),isNaN(this.boundingSphere.radius)&&Le('BufferGeometry.computeBoundingSphere(): Computed radius is NaN. The "position" attribute is likely to have NaN values.',this)}}computeTangents(){let e=this.index,t=this.attributes;if(e===null||t.position===void 0||t.normal===void 0||t.uv===void 0){Le("BufferGeometry: .computeTangents() failed. Missing required attributes (index, position, normal or uv)");return}let n=t.position,i=t.normal,r=t.uv,o=this.getAttribute("tangent");(o===void 0||o.count!==n.count)&&(o=new Bt(new Float32Array(4*n.count),4),this.setAttribute("tangent",o));let a=[],l=[],c=new Uint8Array(n.count);for(let I=0;I<n.count;I++)a[I]=new U,l[I]=new U;let h=new U,u=new U,f=new U,d=new Be,g=new Be,x=new Be,p=new U,m=new U;function b(I,R,N){c[I]=c[R]=c[N]=1,h.fromBufferAttribute(n,I),u.fromBufferAttribute(n,R),f.fromBufferAttribute(n,N),d.fromBufferAttribute(r,I),g.fromBufferAttribute(r,R),x.fromBufferAttribute(r,N),u.sub(h),f.sub(h),g.sub(d),x.sub(d);let O=1/(g.x*x.y-x.x*g.y);isFinite(O)&&(p.copy(u).multiplyScalar(x.y).addScaledVector(f,-g.y).multiplyScalar(O),m.copy(f).multiplyScalar(g.x).addScaledVector(u,-x.x).multiplyScalar(O),a[I].add(p),a[R].add(p),a[N].add(p),l[I].add(m),l[R].add(m),l[N].add(m))}let T=this.groups;T.length===0&&(T=[{start:0,count:e.count}]);for(let I=0,R=T.length;I<R;++I){let N=T[I],O=N.start,D=N.count;for(let P=O,V=O+D;P<V;P+=3)b(e.getX(P+0),e.getX(P+1),e.getX(P+2))}let E=new U,M=new U,w=new U,y=new U;function S(I){w.fromBufferAttribute(i,I),y.copy(w);let R=a[I];E.copy(R),E.sub(w.multiplyScalar(w.dot(R))).normalize(),M.crossVectors(y,R);let O=M.dot(l[I])<0?-1:1;o.setXYZW(I,E.x,E.y,E.z,O)}for(let I=0,R=n.count;I<R;++I)c[I]&&S(I);this._transformed=!0}computeVertexNormals(){let e=this.index,t=this.getAttribute("position");if(t!==void 0){let n=this.getAttribute("normal");if(n===void 0||n.count!==t.count)n=new Bt(new Float32Array(t.count*3),3),this.setAttribute("normal",n);else for(let f=0,d=n.count;f<d;f++)n.setXYZ(f,0,0,0);let i=new U,r=new U,o=new U,a=new U,l=new U,c=new U,h=new U,u=new U;if(e)for(let f=0,d=e.count;f<d;f+=3){let g=e.getX(f+0),x=e.getX(f+1),p=e.getX(f+2);i.fromBufferAttribute(t,g),r.fromBufferAttribute(t,x),o.fromBufferAttribute(t,p),h.subVectors(o,r),u.subVectors(i,r),h.cross(u),a.fromBufferAttribute(n,g),l.fromBufferAttribute(n,x),c.fromBufferAttribute(n,p),a.add(h),l.add(h),c.add(h),n.setXYZ(g,a.x,a.y,a.z),n.setXYZ(x,l.x,l.y,l.z),n.setXYZ(p,c.x,c.y,c.z)}else for(let f=0,d=t.count;f<d;f+=3)i.fromBufferAttribute(t,f+0),r.fromBufferAttribute(t,f+1),o.fromBufferAttribute(t,f+2),h.subVectors(o,r),u.subVectors(i,r),h.cross(u),n.setXYZ(f+0,h.x,h.y,h.z),n.setXYZ(f+1,h.x,h.y,h.z),n.setXYZ(f+2,h.x,h.y,h.z);this.normalizeNormals(),n.needsUpdate=!0}}normalizeNormals(){let e=this.attributes.normal;for(let t=0,n=e.count;t<n;t++)St.fromBufferAttribute(e,t),St.normalize(),e.setXYZ(t,St.x,St.y,St.z)}toNonIndexed(){function e(a,l){let c=a.array,h=a.itemSize,u=a.normalized,f=new c.constructor(l.length*h),d=0,g=0;for(let x=0,p=l.length;x<p;x++){a.isInterleavedBufferAttribute?d=l[x]*a.data.stride+a.offset:d=l[x]*h;for(let m=0;m<h;m++)f[g++]=c[d++]}return new Bt(f,h,u)}if(this.index===null)return Ce("BufferGeometry.toNonIndexed(): BufferGeometry is already non-indexed."),this;let t=new s,n=this.index.array,i=this.attributes;for(let a in i){let l=i[a],c=e(l,n);t.setAttribute(a,c)}let r=this.morphAttributes;for(let a in r){let l=[],c=r[a];for(let h=0,u=c.length;h<u;h++){let f=c[h],d=e(f,n);l.push(d)}t.morphAttributes[a]=l}t.morphTargetsRelative=this.morphTargetsRelative;let o=this.groups;for(let a=0,l=o.length;a<l;a++){let c=o[a];t.addGroup(c.start,c.count,c.materialIndex)}return t}toJSON(){let e={metadata:{version:4.7,type:"BufferGeometry",generator:"BufferGeometry.toJSON"}};if(e.uuid=this.uuid,e.type=this.parameters!==void 0&&this._transformed===!0?"BufferGeometry":this.type,e.name=this.name,Object.keys(this.userData).length>0&&(e.userData=this.userData),this.parameters!==void 0&&this._transformed!==!0){let l=this.parameters;for(let c in l)l[c]!==void 0&&(e[c]=l[c]);return e}e.data={attributes:{}};let t=this.index;t!==null&&(e.data.index={type:t.array.constructor.name,array:Array.prototype.slice.call(t.array)});let n=this.attributes;for(let l in n){let c=n[l];e.data.attributes[l]=c.toJSON(e.data)}let i={},r=!1;for(let l in this.morphAttributes){let c=this.morphAttributes[l],h=[];for(let u=0,f=c.length;u<f;u++){let d=c[u];h.push(d.toJSON(e.data))}h.length>0&&(i[l]=h,r=!0)}r&&(e.data.morphAttributes=i,e.data.morphTargetsRelative=this.morphTargetsRelative);let o=this.groups;o.length>0&&(e.data.groups=JSON.parse(JSON.stringify(o)));let a=this.boundingSphere;return a!==null&&(e.data.boundingSphere=a.toJSON()),e}clone(){return new this.constructor().copy(this)}copy(e){this.index=null,this.attributes={},this.morphAttributes={},this.groups=[],this.boundingBox=null,this.boundingSphere=null;let t={};this.name=e.name;let n=e.index;n!==null&&this.setIndex(n.clone());let i=e.attributes;for(let c in i){let h=i[c];this.setAttribute(c,h.clone(t))}let r=e.morphAttributes;for(let c in r){let h=[],u=r[c];for(let f=0,d=u.length;f<d;f++)h.push(u[f].clone(t));this.morphAttributes[c]=h}this.morphTargetsRelative=e.morphTargetsRelative;let o=e.groups;for(let c=0,h=o.length;c<h;c++){let u=o[c];this.addGroup(u.start,u.count,u.materialIndex)}let a=e.boundingBox;a!==null&&(this.boundingBox=a.clone());let l=e.boundingSphere;return l!==null&&(this.boundingSphere=l.clone()),this.drawRange.start=e.drawRange.start,this.drawRange.count=e.drawRange.count,this.userData=e.userData,this._transformed=e._transformed,this}dispose(){this.dispatchEvent({type:"dispose"})}};var $l=new U,gp=new U,yp=new Ne,un=class{constructor(e=new U(1,0,0),t=0){this.isPlane=!0,this.normal=e,this.constant=t}set(e,t){return this.normal.copy(e),this.constant=t,this}setComponents(e,t,n,i){return this.normal.set(e,t,n),this.constant=i,this}setFromNormalAndCoplanarPoint(e,t){return this.normal.copy(e),this.constant=-t.dot(this.normal),this}setFromCoplanarPoints(e,t,n){let i=$l.subVectors(n,t).cross(gp.subVectors(e,t)).normalize();return this.setFromNormalAndCoplanarPoint(i,e),this}copy(e){return this.normal.copy(e.normal),this.constant=e.constant,this}normalize(){let e=1/this.normal.length();return this.normal.multiplyScalar(e),this.constant*=e,this}negate(){return this.constant*=-1,this.normal.negate(),this}distanceToPoint(e){return this.normal.dot(e)+this.constant}distanceToSphere(e){return this.distanceToPoint(e.center)-e.radius}projectPoint(e,t){return t.copy(e).addScaledVector(this.normal,-this.distanceToPoint(e))}intersectLine(e,t,n=!0){let i=e.delta($l),r=this.normal.dot(i);if(r===0)return this.distanceToPoint(e.start)===0?t.copy(e.start):null;let o=-(e.start.dot(this.normal)+this.constant)/r;return n===!0&&(o<0||o>1)?null:t.copy(e.start).addScaledVector(i,o)}intersectsLine(e){let t=this.distanceToPoint(e.start),n=this.distanceToPoint(e.end);return t<0&&n>0||n<0&&t>0}intersectsBox(e){return e.intersectsPlane(this)}intersectsSphere(e){return e.intersectsPlane(this)}coplanarPoint(e){return e.copy(this.normal).multiplyScalar(-this.constant)}applyMatrix4(e,t){let n=t||yp.getNormalMatrix(e),i=this.coplanarPoint($l).applyMatrix4(e),r=this.normal.applyMatrix3(n).normalize();return this.constant=-i.dot(r),this}translate(e){return this.constant-=e.dot(this.normal),this}equals(e){return e.normal.equals(this.normal)&&e.constant===this.constant}clone(){return new this.constructor().copy(this)}toJSON(){return{normal:this.normal.toArray(),constant:this.constant}}fromJSON(e){return this.normal.fromArray(e.normal),this.constant=e.constant,this}},xp=0,Sn=class extends Mn{constructor(){super(),this.isMaterial=!0,Object.defineProperty(this,"id",{value:xp++}),this.uuid=rr(),this.name="",this.type="Material",this.blending=rs,this.side=li,this.vertexColors=!1,this.opacity=1,this.transparent=!1,this.alphaHash=!1,this.blendSrc=uc,this.blendDst=dc,this.blendEquation=bi,this.blendSrcAlpha=null,this.blendDstAlpha=null,this.blendEquationAlpha=null,this.blendColor=new Ie(0,0,0),this.blendAlpha=0,this.depthFunc=$i,this.depthTest=!0,this.depthWrite=!0,this.stencilWriteMask=255,this.stencilFunc=Ou,this.stencilRef=0,this.stencilFuncMask=255,this.stencilFail=ho,this.stencilZFail=ho,this.stencilZPass=ho,this.stencilWrite=!1,this.clippingPlanes=null,this.clipIntersection=!1,this.clipShadows=!1,this.shadowSide=null,this.colorWrite=!0,this.precision=null,this.polygonOffset=!1,this.polygonOffsetFactor=0,this.polygonOffsetUnits=0,this.dithering=!1,this.alphaToCoverage=!1,this.premultipliedAlpha=!1,this.forceSinglePass=!1,this.allowOverride=!0,this.visible=!0,this.toneMapped=!0,this.userData={},this.version=0,this._alphaTest=0}get alphaTest(){return this._alphaTest}set alphaTest(e){this._alphaTest>0!=e>0&&this.version++,this._alphaTest=e}onBeforeRender(){}onBeforeCompile(){}customProgramCacheKey(){return this.onBeforeCompile.toString()}setValues(e){if(e!==void 0)for(let t in e){let n=e[t];if(n===void 0){Ce(`Material: parameter '${t}' has value of undefined.`);continue}let i=this[t];if(i===void 0){Ce(`Material: '${t}' is not a property of THREE.${this.type}.`);continue}i&&i.isColor?i.set(n):i&&i.isVector2&&n&&n.isVector2||i&&i.isEuler&&n&&n.isEuler||i&&i.isVector3&&n&&n.isVector3?i.copy(n):this[t]=n}}toJSON(e){let t=e===void 0||typeof e=="string";t&&(e={textures:{},images:{}});let n={metadata:{version:4.7,type:"Material",generator:"Material.toJSON"}};n.uuid=this.uuid,n.type=this.type,n.blending=this.blending,n.side=this.side,n.shadowSide=this.shadowSide,n.vertexColors=this.vertexColors,n.opacity=this.opacity,n.transparent=this.transparent,n.blendSrc=this.blendSrc,n.blendDst=this.blendDst,n.blendEquation=this.blendEquation,n.blendSrcAlpha=this.blendSrcAlpha,n.blendDstAlpha=this.blendDstAlpha,n.blendEquationAlpha=this.blendEquationAlpha,n.blendColor=this.blendColor.getHex(),n.blendAlpha=this.blendAlpha,n.depthFunc=this.depthFunc,n.depthTest=this.depthTest,n.depthWrite=this.depthWrite,n.colorWrite=this.colorWrite,n.clipIntersection=this.clipIntersection,n.clipShadows=this.clipShadows,n.stencilWriteMask=this.stencilWriteMask,n.stencilFunc=this.stencilFunc,n.stencilRef=this.stencilRef,n.stencilFuncMask=this.stencilFuncMask,n.stencilFail=this.stencilFail,n.stencilZFail=this.stencilZFail,n.stencilZPass=this.stencilZPass,n.stencilWrite=this.stencilWrite,n.polygonOffset=this.polygonOffset,n.polygonOffsetFactor=this.polygonOffsetFactor,n.polygonOffsetUnits=this.polygonOffsetUnits,n.dithering=this.dithering,n.alphaTest=this.alphaTest,n.alphaHash=this.alphaHash,n.alphaToCoverage=this.alphaToCoverage,n.premultipliedAlpha=this.premultipliedAlpha,n.forceSinglePass=this.forceSinglePass,n.allowOverride=this.allowOverride,n.visible=this.visible,n.toneMapped=this.toneMapped,n.name=this.name,this.color&&this.color.isColor&&(n.color=this.color.getHex()),this.roughness!==void 0&&(n.roughness=this.roughness),this.metalness!==void 0&&(n.metalness=this.metalness),this.sheen!==void 0&&(n.sheen=this.sheen),this.sheenColor&&this.sheenColor.isColor&&(n.sheenColor=this.sheenColor.getHex()),this.sheenRoughness!==void 0&&(n.sheenRoughness=this.sheenRoughness),this.emissive&&this.emissive.isColor&&(n.emissive=this.emissive.getHex()),this.emissiveIntensity!==void 0&&(n.emissiveIntensity=this.emissiveIntensity),this.specular&&this.specular.isColor&&(n.specular=this.specular.getHex()),this.specularIntensity!==void 0&&(n.specularIntensity=this.specularIntensity),this.specularColor&&this.specularColor.isColor&&(n.specularColor=this.specularColor.getHex()),this.shininess!==void 0&&(n.shininess=this.shininess),this.clearcoat!==void 0&&(n.clearcoat=this.clearcoat),this.clearcoatRoughness!==void 0&&(n.clearcoatRoughness=this.clearcoatRoughness),this.diffuseRoughness!==void 0&&(n.diffuseRoughness=this.diffuseRoughness),this.diffuseRoughnessMap&&this.diffuseRoughnessMap.isTexture&&(n.diffuseRoughnessMap=this.diffuseRoughnessMap.toJSON(e).uuid),this.clearcoatMap&&this.clearcoatMap.isTexture&&(n.clearcoatMap=this.clearcoatMap.toJSON(e).uuid),this.clearcoatRoughnessMap&&this.clearcoatRoughnessMap.isTexture&&(n.clearcoatRoughnessMap=this.clearcoatRoughnessMap.toJSON(e).uuid),this.clearcoatNormalMap&&this.clearcoatNormalMap.isTexture&&(n.clearcoatNormalMap=this.clearcoatNormalMap.toJSON(e).uuid,n.clearcoatNormalScale=this.clearcoatNormalScale.toArray()),this.sheenColorMap&&this.sheenColorMap.isTexture&&(n.sheenColorMap=this.sheenColorMap.toJSON(e).uuid),this.sheenRoughnessMap&&this.sheenRoughnessMap.isTexture&&(n.sheenRoughnessMap=this.sheenRoughnessMap.toJSON(e).uuid),this.dispersion!==void 0&&(n.dispersion=this.dispersion),this.retroreflectivity!==void 0&&(n.retroreflectivity=this.retroreflectivity),this.iridescence!==void 0&&(n.iridescence=this.iridescence),this.iridescenceIOR!==void 0&&(n.iridescenceIOR=this.iridescenceIOR),this.iridescenceThicknessMinimum!==void 0&&(n.iridescenceThicknessMinimum=this.iridescenceThicknessMinimum),this.iridescenceThicknessMaximum!==void 0&&(n.iridescenceThicknessMaximum=this.iridescenceThicknessMaximum),this.iridescenceMap&&this.iridescenceMap.isTexture&&(n.iridescenceMap=this.iridescenceMap.toJSON(e).uuid),this.iridescenceThicknessMap&&this.iridescenceThicknessMap.isTexture&&(n.iridescenceThicknessMap=this.iridescenceThicknessMap.toJSON(e).uuid),this.anisotropy!==void 0&&(n.anisotropy=this.anisotropy),this.anisotropyRotation!==void 0&&(n.anisotropyRotation=this.anisotropyRotation),this.anisotropyMap&&this.anisotropyMap.isTexture&&(n.anisotropyMap=this.anisotropyMap.toJSON(e).uuid),this.map&&this.map.isTexture&&(n.map=this.map.toJSON(e).uuid),this.matcap&&this.matcap.isTexture&&(n.matcap=this.matcap.toJSON(e).uuid),this.alphaMap&&this.alphaMap.isTexture&&(n.alphaMap=this.alphaMap.toJSON(e).uuid),this.lightMap&&this.lightMap.isTexture&&(n.lightMap=this.lightMap.toJSON(e).uuid,n.lightMapIntensity=this.lightMapIntensity),this.aoMap&&this.aoMap.isTexture&&(n.aoMap=this.aoMap.toJSON(e).uuid,n.aoMapIntensity=this.aoMapIntensity),this.bumpMap&&this.bumpMap.isTexture&&(n.bumpMap=this.bumpMap.toJSON(e).uuid,n.bumpScale=this.bumpScale),this.normalMap&&this.normalMap.isTexture&&(n.normalMap=this.normalMap.toJSON(e).uuid,n.normalMapType=this.normalMapType,n.normalScale=this.normalScale.toArray()),this.displacementMap&&this.displacementMap.isTexture&&(n.displacementMap=this.displacementMap.toJSON(e).uuid,n.displacementScale=this.displacementScale,n.displacementBias=this.displacementBias),this.roughnessMap&&this.roughnessMap.isTexture&&(n.roughnessMap=this.roughnessMap.toJSON(e).uuid),this.metalnessMap&&this.metalnessMap.isTexture&&(n.metalnessMap=this.metalnessMap.toJSON(e).uuid),this.emissiveMap&&this.emissiveMap.isTexture&&(n.emissiveMap=this.emissiveMap.toJSON(e).uuid),this.specularMap&&this.specularMap.isTexture&&(n.specularMap=this.specularMap.toJSON(e).uuid),this.specularIntensityMap&&this.specularIntensityMap.isTexture&&(n.specularIntensityMap=this.specularIntensityMap.toJSON(e).uuid),this.specularColorMap&&this.specularColorMap.isTexture&&(n.specularColorMap=this.specularColorMap.toJSON(e).uuid),this.envMap&&this.envMap.isTexture&&(n.envMap=this.envMap.toJSON(e).uuid,this.combine!==void 0&&(n.combine=this.combine)),this.envMapRotation!==void 0&&(n.envMapRotation=this.envMapRotation.toArray()),this.envMapIntensity!==void 0&&(n.envMapIntensity=this.envMapIntensity),this.reflectivity!==void 0&&(n.reflectivity=this.reflectivity),this.refractionRatio!==void 0&&(n.refractionRatio=this.refractionRatio),this.gradientMap&&this.gradientMap.isTexture&&(n.gradientMap=this.gradientMap.toJSON(e).uuid),this.transmission!==void 0&&(n.transmission=this.transmission),this.transmissionMap&&this.transmissionMap.isTexture&&(n.transmissionMap=this.transmissionMap.toJSON(e).uuid),this.thickness!==void 0&&(n.thickness=this.thickness),this.thicknessMap&&this.thicknessMap.isTexture&&(n.thicknessMap=this.thicknessMap.toJSON(e).uuid),this.attenuationDistance!==void 0&&(n.attenuationDistance=this.attenuationDistance),this.attenuationColor!==void 0&&(n.attenuationColor=this.attenuationColor.getHex()),this.size!==void 0&&(n.size=this.size),this.sizeAttenuation!==void 0&&(n.sizeAttenuation=this.sizeAttenuation),Array.isArray(this.clippingPlanes)&&this.clippingPlanes.length>0&&(n.clippingPlanes=this.clippingPlanes.map(r=>r.toJSON())),this.rotation!==void 0&&(n.rotation=this.rotation),this.depthPacking!==void 0&&(n.depthPacking=this.depthPacking),this.linewidth!==void 0&&(n.linewidth=this.linewidth),this.linecap!==void 0&&(n.linecap=this.linecap),this.linejoin!==void 0&&(n.linejoin=this.linejoin),this.dashSize!==void 0&&(n.dashSize=this.dashSize),this.gapSize!==void 0&&(n.gapSize=this.gapSize),this.scale!==void 0&&(n.scale=this.scale),this.wireframe!==void 0&&(n.wireframe=this.wireframe),this.wireframeLinewidth!==void 0&&(n.wireframeLinewidth=this.wireframeLinewidth),this.wireframeLinecap!==void 0&&(n.wireframeLinecap=this.wireframeLinecap),this.wireframeLinejoin!==void 0&&(n.wireframeLinejoin=this.wireframeLinejoin),this.flatShading!==void 0&&(n.flatShading=this.flatShading),this.fog!==void 0&&(n.fog=this.fog),Object.keys(this.userData).length>0&&(n.userData=this.userData);function i(r){let o=[];for(let a in r){let l=r[a];delete l.metadata,o.push(l)}return o}if(t){let r=i(e.textures),o=i(e.images);r.length>0&&(n.textures=r),o.length>0&&(n.images=o)}return n}fromJSON(e,t){if(e.uuid!==void 0&&(this.uuid=e.uuid),e.name!==void 0&&(this.name=e.name),e.color!==void 0&&this.color!==void 0&&this.color.setHex(e.color),e.roughness!==void 0&&(this.roughness=e.roughness),e.metalness!==void 0&&(this.metalness=e.metalness),e.sheen!==void 0&&(this.sheen=e.sheen),e.sheenColor!==void 0&&(this.sheenColor=new Ie().setHex(e.sheenColor)),e.sheenRoughness!==void 0&&(this.sheenRoughness=e.sheenRoughness),e.emissive!==void 0&&this.emissive!==void 0&&this.emissive.setHex(e.emissive),e.specular!==void 0&&this.specular!==void 0&&this.specular.setHex(e.specular),e.specularIntensity!==void 0&&(this.specularIntensity=e.specularIntensity),e.specularColor!==void 0&&this.specularColor!==void 0&&this.specularColor.setHex(e.specularColor),e.shininess!==void 0&&(this.shininess=e.shininess),e.clearcoat!==void 0&&(this.clearcoat=e.clearcoat),e.clearcoatRoughness!==void 0&&(this.clearcoatRoughness=e.clearcoatRoughness),e.diffuseRoughness!==void 0&&(this.diffuseRoughness=e.diffuseRoughness),e.dispersion!==void 0&&(this.dispersion=e.dispersion),e.retroreflectivity!==void 0&&(this.retroreflectivity=e.retroreflectivity),e.iridescence!==void 0&&(this.iridescence=e.iridescence),e.iridescenceIOR!==void 0&&(this.iridescenceIOR=e.iridescenceIOR),e.iridescenceThicknessMinimum!==void 0&&(this.iridescenceThicknessMinimum=e.iridescenceThicknessMinimum),e.iridescenceThicknessMaximum!==void 0&&(this.iridescenceThicknessMaximum=e.iridescenceThicknessMaximum),e.iridescenceThicknessRange!==void 0&&(this.iridescenceThicknessMinimum=e.iridescenceThicknessRange[0],this.iridescenceThicknessMaximum=e.iridescenceThicknessRange[1]),e.transmission!==void 0&&(this.transmission=e.transmission),e.thickness!==void 0&&(this.thickness=e.thickness),e.attenuationDistance!==void 0&&(this.attenuationDistance=e.attenuationDistance),e.attenuationColor!==void 0&&this.attenuationColor!==void 0&&this.attenuationColor.setHex(e.attenuationColor),e.anisotropy!==void 0&&(this.anisotropy=e.anisotropy),e.anisotropyRotation!==void 0&&(this.anisotropyRotation=e.anisotropyRotation),e.fog!==void 0&&(this.fog=e.fog),e.flatShading!==void 0&&(this.flatShading=e.flatShading),e.blending!==void 0&&(this.blending=e.blending),e.combine!==void 0&&(this.combine=e.combine),e.side!==void 0&&(this.side=e.side),e.shadowSide!==void 0&&(this.shadowSide=e.shadowSide),e.opacity!==void 0&&(this.opacity=e.opacity),e.transparent!==void 0&&(this.transparent=e.transparent),e.alphaTest!==void 0&&(this.alphaTest=e.alphaTest),e.alphaHash!==void 0&&(this.alphaHash=e.alphaHash),e.depthFunc!==void 0&&(this.depthFunc=e.depthFunc),e.depthTest!==void 0&&(this.depthTest=e.depthTest),e.depthWrite!==void 0&&(this.depthWrite=e.depthWrite),e.colorWrite!==void 0&&(this.colorWrite=e.colorWrite),e.clippingPlanes!==void 0&&(this.clippingPlanes=e.clippingPlanes.map(n=>new un().fromJSON(n))),e.clipIntersection!==void 0&&(this.clipIntersection=e.clipIntersection),e.clipShadows!==void 0&&(this.clipShadows=e.clipShadows),e.depthPacking!==void 0&&(this.depthPacking=e.depthPacking),e.blendSrc!==void 0&&(this.blendSrc=e.blendSrc),e.blendDst!==void 0&&(this.blendDst=e.blendDst),e.blendEquation!==void 0&&(this.blendEquation=e.blendEquation),e.blendSrcAlpha!==void 0&&(this.blendSrcAlpha=e.blendSrcAlpha),e.blendDstAlpha!==void 0&&(this.blendDstAlpha=e.blendDstAlpha),e.blendEquationAlpha!==void 0&&(this.blendEquationAlpha=e.blendEquationAlpha),e.blendColor!==void 0&&this.blendColor!==void 0&&this.blendColor.setHex(e.blendColor),e.blendAlpha!==void 0&&(this.blendAlpha=e.blendAlpha),e.stencilWriteMask!==void 0&&(this.stencilWriteMask=e.stencilWriteMask),e.stencilFunc!==void 0&&(this.stencilFunc=e.stencilFunc),e.stencilRef!==void 0&&(this.stencilRef=e.stencilRef),e.stencilFuncMask!==void 0&&(this.stencilFuncMask=e.stencilFuncMask),e.stencilFail!==void 0&&(this.stencilFail=e.stencilFail),e.stencilZFail!==void 0&&(this.stencilZFail=e.stencilZFail),e.stencilZPass!==void 0&&(this.stencilZPass=e.stencilZPass),e.stencilWrite!==void 0&&(this.stencilWrite=e.stencilWrite),e.wireframe!==void 0&&(this.wireframe=e.wireframe),e.wireframeLinewidth!==void 0&&(this.wireframeLinewidth=e.wireframeLinewidth),e.wireframeLinecap!==void 0&&(this.wireframeLinecap=e.wireframeLinecap),e.wireframeLinejoin!==void 0&&(this.wireframeLinejoin=e.wireframeLinejoin),e.rotation!==void 0&&(this.rotation=e.rotation),e.linewidth!==void 0&&(this.linewidth=e.linewidth),e.linecap!==void 0&&(this.linecap=e.linecap),e.linejoin!==void 0&&(this.linejoin=e.linejoin),e.dashSize!==void 0&&(this.dashSize=e.dashSize),e.gapSize!==void 0&&(this.gapSize=e.gapSize),e.scale!==void 0&&(this.scale=e.scale),e.polygonOffset!==void 0&&(this.polygonOffset=e.polygonOffset),e.polygonOffsetFactor!==void 0&&(this.polygonOffsetFactor=e.polygonOffsetFactor),e.polygonOffsetUnits!==void 0&&(this.polygonOffsetUnits=e.polygonOffsetUnits),e.dithering!==void 0&&(this.dithering=e.dithering),e.alphaToCoverage!==void 0&&(this.alphaToCoverage=e.alphaToCoverage),e.premultipliedAlpha!==void 0&&(this.premultipliedAlpha=e.premultipliedAlpha),e.forceSinglePass!==void 0&&(this.forceSinglePass=e.forceSinglePass),e.allowOverride!==void 0&&(this.allowOverride=e.allowOverride),e.visible!==void 0&&(this.visible=e.visible),e.toneMapped!==void 0&&(this.toneMapped=e.toneMapped),e.userData!==void 0&&(this.userData=e.userData),e.vertexColors!==void 0&&(typeof e.vertexColors=="number"?this.vertexColors=e.vertexColors>0:this.vertexColors=e.vertexColors),e.size!==void 0&&(this.size=e.size),e.sizeAttenuation!==void 0&&(this.sizeAttenuation=e.sizeAttenuation),e.map!==void 0&&(this.map=t[e.map]||null),e.matcap!==void 0&&(this.matcap=t[e.matcap]||null),e.alphaMap!==void 0&&(this.alphaMap=t[e.alphaMap]||null),e.bumpMap!==void 0&&(this.bumpMap=t[e.bumpMap]||null),e.bumpScale!==void 0&&(this.bumpScale=e.bumpScale),e.normalMap!==void 0&&(this.normalMap=t[e.normalMap]||null),e.normalMapType!==void 0&&(this.normalMapType=e.normalMapType),e.normalScale!==void 0){let n=e.normalScale;Array.isArray(n)===!1&&(n=[n,n]),this.normalScale=new Be().fromArray(n)}return e.displacementMap!==void 0&&(this.displacementMap=t[e.displacementMap]||null),e.displacementScale!==void 0&&(this.displacementScale=e.displacementScale),e.displacementBias!==void 0&&(this.displacementBias=e.displacementBias),e.roughnessMap!==void 0&&(this.roughnessMap=t[e.roughnessMap]||null),e.metalnessMap!==void 0&&(this.metalnessMap=t[e.metalnessMap]||null),e.emissiveMap!==void 0&&(this.emissiveMap=t[e.emissiveMap]||null),e.emissiveIntensity!==void 0&&(this.emissiveIntensity=e.emissiveIntensity),e.specularMap!==void 0&&(this.specularMap=t[e.specularMap]||null),e.specularIntensityMap!==void 0&&(this.specularIntensityMap=t[e.specularIntensityMap]||null),e.specularColorMap!==void 0&&(this.specularColorMap=t[e.specularColorMap]||null),e.envMap!==void 0&&(this.envMap=t[e.envMap]||null),e.envMapRotation!==void 0&&this.envMapRotation.fromArray(e.envMapRotation),e.envMapIntensity!==void 0&&(this.envMapIntensity=e.envMapIntensity),e.reflectivity!==void 0&&(this.reflectivity=e.reflectivity),e.refractionRatio!==void 0&&(this.refractionRatio=e.refractionRatio),e.lightMap!==void 0&&(this.lightMap=t[e.lightMap]||null),e.lightMapIntensity!==void 0&&(this.lightMapIntensity=e.lightMapIntensity),e.aoMap!==void 0&&(this.aoMap=t[e.aoMap]||null),e.aoMapIntensity!==void 0&&(this.aoMapIntensity=e.aoMapIntensity),e.gradientMap!==void 0&&(this.gradientMap=t[e.gradientMap]||null),e.clearcoatMap!==void 0&&(this.clearcoatMap=t[e.clearcoatMap]||null),e.clearcoatRoughnessMap!==void 0&&(this.clearcoatRoughnessMap=t[e.clearcoatRoughnessMap]||null),e.clearcoatNormalMap!==void 0&&(this.clearcoatNormalMap=t[e.clearcoatNormalMap]||null),e.clearcoatNormalScale!==void 0&&(this.clearcoatNormalScale=new Be().fromArray(e.clearcoatNormalScale)),e.diffuseRoughnessMap!==void 0&&(this.diffuseRoughnessMap=t[e.diffuseRoughnessMap]||null),e.iridescenceMap!==void 0&&(this.iridescenceMap=t[e.iridescenceMap]||null),e.iridescenceThicknessMap!==void 0&&(this.iridescenceThicknessMap=t[e.iridescenceThicknessMap]||null),e.transmissionMap!==void 0&&(this.transmissionMap=t[e.transmissionMap]||null),e.thicknessMap!==void 0&&(this.thicknessMap=t[e.thicknessMap]||null),e.anisotropyMap!==void 0&&(this.anisotropyMap=t[e.anisotropyMap]||null),e.sheenColorMap!==void 0&&(this.sheenColorMap=t[e.sheenColorMap]||null),e.sheenRoughnessMap!==void 0&&(this.sheenRoughnessMap=t[e.sheenRoughnessMap]||null),this}clone(){return new this.constructor().copy(this)}copy(e){this.name=e.name,this.blending=e.blending,this.side=e.side,this.vertexColors=e.vertexColors,this.opacity=e.opacity,this.transparent=e.transparent,this.blendSrc=e.blendSrc,this.blendDst=e.blendDst,this.blendEquation=e.blendEquation,this.blendSrcAlpha=e.blendSrcAlpha,this.blendDstAlpha=e.blendDstAlpha,this.blendEquationAlpha=e.blendEquationAlpha,this.blendColor.copy(e.blendColor),this.blendAlpha=e.blendAlpha,this.depthFunc=e.depthFunc,this.depthTest=e.depthTest,this.depthWrite=e.depthWrite,this.stencilWriteMask=e.stencilWriteMask,this.stencilFunc=e.stencilFunc,this.stencilRef=e.stencilRef,this.stencilFuncMask=e.stencilFuncMask,this.stencilFail=e.stencilFail,this.stencilZFail=e.stencilZFail,this.stencilZPass=e.stencilZPass,this.stencilWrite=e.stencilWrite;let t=e.clippingPlanes,n=null;if(t!==null){let i=t.length;n=new Array(i);for(let r=0;r!==i;++r)n[r]=t[r].clone()}return this.clippingPlanes=n,this.clipIntersection=e.clipIntersection,this.clipShadows=e.clipShadows,this.shadowSide=e.shadowSide,this.colorWrite=e.colorWrite,this.precision=e.precision,this.polygonOffset=e.polygonOffset,this.polygonOffsetFactor=e.polygonOffsetFactor,this.polygonOffsetUnits=e.polygonOffsetUnits,this.dithering=e.dithering,this.alphaTest=e.alphaTest,this.alphaHash=e.alphaHash,this.alphaToCoverage=e.alphaToCoverage,this.premultipliedAlpha=e.premultipliedAlpha,this.forceSinglePass=e.forceSinglePass,this.allowOverride=e.allowOverride,this.visible=e.visible,this.toneMapped=e.toneMapped,this.userData=JSON.parse(JSON.stringify(e.userData)),this}dispose(){this.dispatchEvent({type:"dispose"})}set needsUpdate(e){e===!0&&this.version++}};var Ln=new U,Zl=new U,Xr=new U,qr=new U,Us=class{constructor(e=new U,t=new U(0,0,-1)){this.origin=e,this.direction=t}set(e,t){return this.origin.copy(e),this.direction.copy(t),this}copy(e){return this.origin.copy(e.origin),this.direction.copy(e.direction),this}at(e,t){return t.copy(this.origin).addScaledVector(this.direction,e)}lookAt(e){return this.direction.copy(e).sub(this.origin).normalize(),this}recast(e){return this.origin.copy(this.at(e,Ln)),this}closestPointToPoint(e,t){t.subVectors(e,this.origin);let n=t.dot(this.direction);return n<0?t.copy(this.origin):t.copy(this.origin).addScaledVector(this.direction,n)}distanceToPoint(e){return Math.sqrt(this.distanceSqToPoint(e))}distanceSqToPoint(e){let t=Ln.subVectors(e,this.origin).dot(this.direction);return t<0?this.origin.distanceToSquared(e):(Ln.copy(this.origin).addScaledVector(this.direction,t),Ln.distanceToSquared(e))}distanceSqToSegment(e,t,n,i){Zl.copy(e).add(t).multiplyScalar(.5),Xr.copy(t).sub(e).normalize(),qr.copy(this.origin).sub(Zl);let r=e.distanceTo(t)*.5,o=-this.direction.dot(Xr),a=qr.dot(this.direction),l=-qr.dot(Xr),c=qr.lengthSq(),h=Math.abs(1-o*o),u,f,d,g;if(h>0)if(u=o*l-a,f=o*a-l,g=r*h,u>=0)if(f>=-g)if(f<=g){let x=1/h;u*=x,f*=x,d=u*(u+o*f+2*a)+f*(o*u+f+2*l)+c}else f=r,u=Math.max(0,-(o*f+a)),d=-u*u+f*(f+2*l)+c;else f=-r,u=Math.max(0,-(o*f+a)),d=-u*u+f*(f+2*l)+c;else f<=-g?(u=Math.max(0,-(-o*r+a)),f=u>0?-r:Math.min(Math.max(-r,-l),r),d=-u*u+f*(f+2*l)+c):f<=g?(u=0,f=Math.min(Math.max(-r,-l),r),d=f*(f+2*l)+c):(u=Math.max(0,-(o*r+a)),f=u>0?r:Math.min(Math.max(-r,-l),r),d=-u*u+f*(f+2*l)+c);else f=o>0?-r:r,u=Math.max(0,-(o*f+a)),d=-u*u+f*(f+2*l)+c;return n&&n.copy(this.origin).addScaledVector(this.direction,u),i&&i.copy(Zl).addScaledVector(Xr,f),d}intersectSphere(e,t){if(e.radius<0)return null;Ln.subVectors(e.center,this.origin);let n=Ln.dot(this.direction),i=Ln.dot(Ln)-n*n,r=e.radius*e.radius;if(i>r)return null;let o=Math.sqrt(r-i),a=n-o,l=n+o;return l<0?null:a<0?this.at(l,t):this.at(a,t)}intersectsSphere(e){return e.radius<0?!1:this.distanceSqToPoint(e.center)<=e.radius*e.radius}distanceToPlane(e){let t=e.normal.dot(this.direction);if(t===0)return e.distanceToPoint(this.origin)===0?0:null;let n=-(this.origin.dot(e.normal)+e.constant)/t;return n>=0?n:null}intersectPlane(e,t){let n=this.distanceToPlane(e);return n===null?null:this.at(n,t)}intersectsPlane(e){let t=e.distanceToPoint(this.origin);return t===0||e.normal.dot(this.direction)*t<0}intersectBox(e,t){let n,i,r,o,a,l,c=1/this.direction.x,h=1/this.direction.y,u=1/this.direction.z,f=this.origin;return c>=0?(n=(e.min.x-f.x)*c,i=(e.max.x-f.x)*c):(n=(e.max.x-f.x)*c,i=(e.min.x-f.x)*c),h>=0?(r=(e.min.y-f.y)*h,o=(e.max.y-f.y)*h):(r=(e.max.y-f.y)*h,o=(e.min.y-f.y)*h),n>o||r>i||((r>n||isNaN(n))&&(n=r),(o<i||isNaN(i))&&(i=o),u>=0?(a=(e.min.z-f.z)*u,l=(e.max.z-f.z)*u):(a=(e.max.z-f.z)*u,l=(e.min.z-f.z)*u),n>l||a>i)||((a>n||n!==n)&&(n=a),(l<i||i!==i)&&(i=l),i<0)?null:this.at(n>=0?n:i,t)}intersectsBox(e){return this.intersectBox(e,Ln)!==null}intersectTriangle(e,t,n,i,r){let o=this.origin,a=this.direction,l=a.x,c=a.y,h=a.z,u=e.x-o.x,f=e.y-o.y,d=e.z-o.z,g=t.x-o.x,x=t.y-o.y,p=t.z-o.z,m=n.x-o.x,b=n.y-o.y,T=n.z-o.z,E=Math.abs(l),M=Math.abs(c),w=Math.abs(h),y,S,I,R,N,O,D,P,V,W,G,ee;if(E>=M&&E>=w?(I=l,O=u,V=g,ee=m,l>=0?(y=c,S=h,R=f,N=d,D=x,P=p,W=b,G=T):(y=h,S=c,R=d,N=f,D=p,P=x,W=T,G=b)):M>=w?(I=c,O=f,V=x,ee=b,c>=0?(y=h,S=l,R=d,N=u,D=p,P=g,W=T,G=m):(y=l,S=h,R=u,N=d,D=g,P=p,W=m,G=T)):(I=h,O=d,V=p,ee=T,h>=0?(y=l,S=c,R=u,N=f,D=g,P=x,W=m,G=b):(y=c,S=l,R=f,N=u,D=x,P=g,W=b,G=m)),I===0)return null;let X=y/I,Q=S/I,te=1/I,Me=R-X*O,Fe=N-Q*O,J=D-X*V,me=P-Q*V,ve=W-X*ee,Te=G-Q*ee,ge=ve*me-Te*J,Oe=Me*Te-Fe*ve,dt=J*Fe-me*Me;if(i){if(ge<0||Oe<0||dt<0)return null}else if((ge<0||Oe<0||dt<0)&&(ge>0||Oe>0||dt>0))return null;let Pe=ge+Oe+dt;if(Pe===0)return null;let Je=te*(ge*O+Oe*V+dt*ee);return(Pe>0?Je<0:Je>0)?null:this.at(Je/Pe,r)}applyMatrix4(e){return this.origin.applyMatrix4(e),this.direction.transformDirection(e),this}equals(e){return e.origin.equals(this.origin)&&e.direction.equals(this.direction)}clone(){return new this.constructor().copy(this)}},Qi=class extends Sn{constructor(e){super(),this.isMeshBasicMaterial=!0,this.type="MeshBasicMaterial",this.color=new Ie(16777215),this.map=null,this.lightMap=null,this.lightMapIntensity=1,this.aoMap=null,this.aoMapIntensity=1,this.specularMap=null,this.alphaMap=null,this.envMap=null,this.envMapRotation=new On,this.combine=Yo,this.reflectivity=1,this.refractionRatio=.98,this.wireframe=!1,this.wireframeLinewidth=1,this.wireframeLinecap="round",this.wireframeLinejoin="round",this.fog=!0,this.setValues(e)}copy(e){return super.copy(e),this.color.copy(e.color),this.map=e.map,this.lightMap=e.lightMap,this.lightMapIntensity=e.lightMapIntensity,this.aoMap=e.aoMap,this.aoMapIntensity=e.aoMapIntensity,this.specularMap=e.specularMap,this.alphaMap=e.alphaMap,this.envMap=e.envMap,this.envMapRotation.copy(e.envMapRotation),this.combine=e.combine,this.reflectivity=e.reflectivity,this.refractionRatio=e.refractionRatio,this.wireframe=e.wireframe,this.wireframeLinewidth=e.wireframeLinewidth,this.wireframeLinecap=e.wireframeLinecap,this.wireframeLinejoin=e.wireframeLinejoin,this.fog=e.fog,this}},Jh=new je,yi=new Us,Yr=new Bn,Kh=new U,$r=new U,Zr=new U,Jr=new U,Jl=new U,Kr=new U,jh=new U,jr=new U,ht=class extends Rt{constructor(e=new Et,t=new Qi){super(),this.isMesh=!0,this.type="Mesh",this.geometry=e,this.material=t,this.morphTargetDictionary=void 0,this.morphTargetInfluences=void 0,this.count=1,this.updateMorphTargets()}copy(e,t){return super.copy(e,t),e.morphTargetInfluences!==void 0?this.morphTargetInfluences=e.morphTargetInfluences.slice():this.morphTargetInfluences=void 0,e.morphTargetDictionary!==void 0?this.morphTargetDictionary=Object.assign({},e.morphTargetDictionary):this.morphTargetDictionary=void 0,this.material=Array.isArray(e.material)?e.material.slice():e.material,this.geometry=e.geometry,this}updateMorphTargets(){let t=this.geometry.morphAttributes,n=Object.keys(t);if(n.length>0){let i=t[n[0]];if(i!==void 0){this.morphTargetInfluences=[],this.morphTargetDictionary={};for(let r=0,o=i.length;r<o;r++){let a=i[r].name||String(r);this.morphTargetInfluences.push(0),this.morphTargetDictionary[a]=r}}}}getVertexPosition(e,t){let n=this.geometry,i=n.attributes.position,r=n.morphAttributes.position,o=n.morphTargetsRelative;t.fromBufferAttribute(i,e);let a=this.morphTargetInfluences;if(r&&a){Kr.set(0,0,0);for(let l=0,c=r.length;l<c;l++){let h=a[l],u=r[l];h!==0&&(Jl.fromBufferAttribute(u,e),o?Kr.addScaledVector(Jl,h):Kr.addScaledVector(Jl.sub(t),h))}t.add(Kr)}return t}intersectsFrustum(e){return e.intersectsObject(this)}raycast(e,t){let n=this.geometry,i=this.material,r=this.matrixWorld;i!==void 0&&(n.boundingSphere===null&&n.computeBoundingSphere(),Yr.copy(n.boundingSphere),Yr.applyMatrix4(r),yi.copy(e.ray).recast(e.near),!(Yr.containsPoint(yi.origin)===!1&&(yi.intersectSphere(Yr,Kh)===null||yi.origin.distanceToSquared(Kh)>(e.far-e.near)**2))&&(Jh.copy(r).invert(),yi.copy(e.ray).applyMatrix4(Jh),!(n.boundingBox!==null&&yi.intersectsBox(n.boundingBox)===!1)&&this._computeIntersections(e,t,yi)))}_computeIntersections(e,t,n){let i,r=this.geometry,o=this.material,a=r.index,l=r.attributes.position,c=r.attributes.uv,h=r.attributes.uv1,u=r.attributes.normal,f=r.groups,d=r.drawRange;if(a!==null)if(Array.isArray(o))for(let g=0,x=f.length;g<x;g++){let p=f[g],m=o[p.materialIndex],b=Math.max(p.start,d.start),T=Math.min(a.count,Math.min(p.start+p.count,d.start+d.count));for(let E=b,M=T;E<M;E+=3){let w=a.getX(E),y=a.getX(E+1),S=a.getX(E+2);i=Qr(this,m,e,n,c,h,u,w,y,S),i&&(i.faceIndex=Math.floor(E/3),i.face.materialIndex=p.materialIndex,t.push(i))}}else{let g=Math.max(0,d.start),x=Math.min(a.count,d.start+d.count);for(let p=g,m=x;p<m;p+=3){let b=a.getX(p),T=a.getX(p+1),E=a.getX(p+2);i=Qr(this,o,e,n,c,h,u,b,T,E),i&&(i.faceIndex=Math.floor(p/3),t.push(i))}}else if(l!==void 0)if(Array.isArray(o))for(let g=0,x=f.length;g<x;g++){let p=f[g],m=o[p.materialIndex],b=Math.max(p.start,d.start),T=Math.min(l.count,Math.min(p.start+p.count,d.start+d.count));for(let E=b,M=T;E<M;E+=3){let w=E,y=E+1,S=E+2;i=Qr(this,m,e,n,c,h,u,w,y,S),i&&(i.faceIndex=Math.floor(E/3),i.face.materialIndex=p.materialIndex,t.push(i))}}else{let g=Math.max(0,d.start),x=Math.min(l.count,d.start+d.count);for(let p=g,m=x;p<m;p+=3){let b=p,T=p+1,E=p+2;i=Qr(this,o,e,n,c,h,u,b,T,E),i&&(i.faceIndex=Math.floor(p/3),t.push(i))}}}};function vp(s,e,t,n,i,r,o,a){let l;if(e.side===Ct?l=n.intersectTriangle(o,r,i,!0,a):l=n.intersectTriangle(i,r,o,e.side===li,a),l===null)return null;jr.copy(a),jr.applyMatrix4(s.matrixWorld);let c=t.ray.origin.distanceTo(jr);return c<t.near||c>t.far?null:{distance:c,point:jr.clone(),object:s}}function Qr(s,e,t,n,i,r,o,a,l,c){s.getVertexPosition(a,$r),s.getVertexPosition(l,Zr),s.getVertexPosition(c,Jr);let h=vp(s,e,t,n,$r,Zr,Jr,jh);if(h){let u=new U;Nn.getBarycoord(jh,$r,Zr,Jr,u),i&&(h.uv=Nn.getInterpolatedAttribute(i,a,l,c,u,new Be)),r&&(h.uv1=Nn.getInterpolatedAttribute(r,a,l,c,u,new Be)),o&&(h.normal=Nn.getInterpolatedAttribute(o,a,l,c,u,new U),h.normal.dot(n.direction)>0&&h.normal.multiplyScalar(-1));let f={a,b:l,c,normal:new U,materialIndex:0};Nn.getNormal($r,Zr,Jr,f.normal),h.face=f,h.barycoord=u}return h}var To=class extends Vt{constructor(e=null,t=1,n=1,i,r,o,a,l,c=wt,h=wt,u,f){super(null,o,a,l,c,h,i,r,u,f),this.isDataTexture=!0,this.image={data:e,width:t,height:n},this.generateMipmaps=!1,this.flipY=!1,this.unpackAlignment=1}};var kn=class extends Bt{constructor(e,t,n,i=1){super(e,t,n),this.isInstancedBufferAttribute=!0,this.meshPerAttribute=i}copy(e){return super.copy(e),this.meshPerAttribute=e.meshPerAttribute,this}toJSON(){let e=super.toJSON();return e.meshPerAttribute=this.meshPerAttribute,e.isInstancedBufferAttribute=!0,e}};var xi=new Bn,_p=new Be(.5,.5),eo=new U,ni=class{constructor(e=new un,t=new un,n=new un,i=new un,r=new un,o=new un){this.planes=[e,t,n,i,r,o]}set(e,t,n,i,r,o){let a=this.planes;return a[0].copy(e),a[1].copy(t),a[2].copy(n),a[3].copy(i),a[4].copy(r),a[5].copy(o),this}copy(e){let t=this.planes;for(let n=0;n<6;n++)t[n].copy(e.planes[n]);return this}setFromProjectionMatrix(e,t=tn,n=!1){let i=this.planes,r=e.elements,o=r[0],a=r[1],l=r[2],c=r[3],h=r[4],u=r[5],f=r[6],d=r[7],g=r[8],x=r[9],p=r[10],m=r[11],b=r[12],T=r[13],E=r[14],M=r[15];if(i[0].setComponents(c-o,d-h,m-g,M-b).normalize(),i[1].setComponents(c+o,d+h,m+g,M+b).normalize(),i[2].setComponents(c+a,d+u,m+x,M+T).normalize(),i[3].setComponents(c-a,d-u,m-x,M-T).normalize(),n)i[4].setComponents(l,f,p,E).normalize(),i[5].setComponents(c-l,d-f,m-p,M-E).normalize();else if(i[4].setComponents(c-l,d-f,m-p,M-E).normalize(),t===tn)i[5].setComponents(c+l,d+f,m+p,M+E).normalize();else if(t===Zi)i[5].setComponents(l,f,p,E).normalize();else throw new Error("THREE.Frustum.setFromProjectionMatrix(): Invalid coordinate system: "+t);return this}intersectsObject(e){if(e.boundingSphere!==void 0)e.boundingSphere===null&&e.computeBoundingSphere(),xi.copy(e.boundingSphere).applyMatrix4(e.matrixWorld);else{let t=e.geometry;t.boundingSphere===null&&t.computeBoundingSphere(),xi.copy(t.boundingSphere).applyMatrix4(e.matrixWorld)}return this.intersectsSphere(xi)}intersectsSprite(e){xi.center.set(0,0,0);let t=_p.distanceTo(e.center);return xi.radius=.7071067811865476+t,xi.applyMatrix4(e.matrixWorld),this.intersectsSphere(xi)}intersectsSphere(e){let t=this.planes,n=e.center,i=-e.radius;for(let r=0;r<6;r++)if(t[r].distanceToPoint(n)<i)return!1;return!0}intersectsBox(e){let t=this.planes;for(let n=0;n<6;n++){let i=t[n];if(eo.x=i.normal.x>0?e.max.x:e.min.x,eo.y=i.normal.y>0?e.max.y:e.min.y,eo.z=i.normal.z>0?e.max.z:e.min.z,i.distanceToPoint(eo)<0)return!1}return!0}containsPoint(e){let t=this.planes;for(let n=0;n<6;n++)if(t[n].distanceToPoint(e)<0)return!1;return!0}clone(){return new this.constructor().copy(this)}},Qh=new je,Ro=class s{constructor(){this.coordinateSystem=tn,this._frustums=[],this._count=0}setFromArrayCamera(e){let t=e.cameras,n=this._frustums;for(let i=0;i<t.length;i++){let r=t[i];Qh.multiplyMatrices(r.projectionMatrix,r.matrixWorldInverse),n[i]===void 0&&(n[i]=new ni),n[i].setFromProjectionMatrix(Qh,r.coordinateSystem,r.reversedDepth)}return this._count=t.length,this}getFrustum(e){return this._frustums[e]}intersectsObject(e){let t=this._frustums;for(let n=0;n<this._count;n++)if(t[n].intersectsObject(e))return!0;return!1}intersectsSprite(e){let t=this._frustums;for(let n=0;n<this._count;n++)if(t[n].intersectsSprite(e))return!0;return!1}intersectsSphere(e){let t=this._frustums;for(let n=0;n<this._count;n++)if(t[n].intersectsSphere(e))return!0;return!1}intersectsBox(e){let t=this._frustums;for(let n=0;n<this._count;n++)if(t[n].intersectsBox(e))return!0;return!1}containsPoint(e){let t=this._frustums;for(let n=0;n<this._count;n++)if(t[n].containsPoint(e))return!0;return!1}copy(e){this.coordinateSystem=e.coordinateSystem;let t=this._frustums,n=e._frustums;for(let i=0;i<e._count;i++)t[i]===void 0&&(t[i]=new ni),t[i].copy(n[i]);return this._count=e._count,this}clone(){return new s().copy(this)}};var es=class extends Sn{constructor(e){super(),this.isLineBasicMaterial=!0,this.type="LineBasicMaterial",this.color=new Ie(16777215),this.map=null,this.linewidth=1,this.linecap="round",this.linejoin="round",this.fog=!0,this.setValues(e)}copy(e){return super.copy(e),this.color.copy(e.color),this.map=e.map,this.linewidth=e.linewidth,this.linecap=e.linecap,this.linejoin=e.linejoin,this.fog=e.fog,this}},Co=new U,Po=new U,eu=new je,Es=new Us,to=new Bn,Kl=new U,tu=new U,Io=class extends Rt{constructor(e=new Et,t=new es){super(),this.isLine=!0,this.type="Line",this.geometry=e,this.material=t,this.morphTargetDictionary=void 0,this.morphTargetInfluences=void 0,this.updateMorphTargets()}copy(e,t){return super.copy(e,t),e.morphTargetInfluences!==void 0?this.morphTargetInfluences=e.morphTargetInfluences.slice():this.morphTargetInfluences=void 0,e.morphTargetDictionary!==void 0?this.morphTargetDictionary=Object.assign({},e.morphTargetDictionary):this.morphTargetDictionary=void 0,this.material=Array.isArray(e.material)?e.material.slice():e.material,this.geometry=e.geometry,this}computeLineDistances(){let e=this.geometry;if(e.index===null){let t=e.attributes.position,n=[0];for(let i=1,r=t.count;i<r;i++)Co.fromBufferAttribute(t,i-1),Po.fromBufferAttribute(t,i),n[i]=n[i-1],n[i]+=Co.distanceTo(Po);e.setAttribute("lineDistance",new nt(n,1))}else Ce("Line.computeLineDistances(): Computation only possible with non-indexed BufferGeometry.");return this}intersectsFrustum(e){return e.intersectsObject(this)}raycast(e,t){let n=this.geometry,i=this.matrixWorld,r=e.params.Line.threshold,o=n.drawRange;if(n.boundingSphere===null&&n.computeBoundingSphere(),to.copy(n.boundingSphere),to.applyMatrix4(i),to.radius+=r,e.ray.intersectsSphere(to)===!1)return;eu.copy(i).invert(),Es.copy(e.ray).applyMatrix4(eu);let a=r/((this.scale.x+this.scale.y+this.scale.z)/3),l=a*a,c=this.isLineSegments?2:1,h=n.index,f=n.attributes.position;if(h!==null){let d=Math.max(0,o.start),g=Math.min(h.count,o.start+o.count);for(let x=d,p=g-1;x<p;x+=c){let m=h.getX(x),b=h.getX(x+1),T=no(this,e,Es,l,m,b,x);T&&t.push(T)}if(this.isLineLoop){let x=h.getX(g-1),p=h.getX(d),m=no(this,e,Es,l,x,p,g-1);m&&t.push(m)}}else{let d=Math.max(0,o.start),g=Math.min(f.count,o.start+o.count);for(let x=d,p=g-1;x<p;x+=c){let m=no(this,e,Es,l,x,x+1,x);m&&t.push(m)}if(this.isLineLoop){let x=no(this,e,Es,l,g-1,d,g-1);x&&t.push(x)}}}updateMorphTargets(){let t=this.geometry.morphAttributes,n=Object.keys(t);if(n.length>0){let i=t[n[0]];if(i!==void 0){this.morphTargetInfluences=[],this.morphTargetDictionary={};for(let r=0,o=i.length;r<o;r++){let a=i[r].name||String(r);this.morphTargetInfluences.push(0),this.morphTargetDictionary[a]=r}}}}};function no(s,e,t,n,i,r,o){let a=s.geometry.attributes.position;if(Co.fromBufferAttribute(a,i),Po.fromBufferAttribute(a,r),t.distanceSqToSegment(Co,Po,Kl,tu)>n)return;Kl.applyMatrix4(s.matrixWorld);let c=e.ray.origin.distanceTo(Kl);if(!(c<e.near||c>e.far))return{distance:c,point:tu.clone().applyMatrix4(s.matrixWorld),index:o,face:null,faceIndex:null,barycoord:null,object:s}}var nu=new U,iu=new U,Os=class extends Io{constructor(e,t){super(e,t),this.isLineSegments=!0,this.type="LineSegments"}computeLineDistances(){let e=this.geometry;if(e.index===null){let t=e.attributes.position,n=[];for(let i=0,r=t.count;i<r;i+=2)nu.fromBufferAttribute(t,i),iu.fromBufferAttribute(t,i+1),n[i]=i===0?0:n[i-1],n[i+1]=n[i]+nu.distanceTo(iu);e.setAttribute("lineDistance",new nt(n,1))}else Ce("LineSegments.computeLineDistances(): Computation only possible with non-indexed BufferGeometry.");return this}};var Bs=class extends Vt{constructor(e=[],t=Mi,n,i,r,o,a,l,c,h){super(e,t,n,i,r,o,a,l,c,h),this.isCubeTexture=!0,this.flipY=!1}get images(){return this.image}set images(e){this.image=e}};var zn=class extends Vt{constructor(e,t,n=dn,i,r,o,a=wt,l=wt,c,h=Un,u=1){if(h!==Un&&h!==Hn)throw new Error("THREE.DepthTexture: format must be either THREE.DepthFormat or THREE.DepthStencilFormat");let f={width:e,height:t,depth:u};super(f,i,r,o,a,l,h,n,c),this.isDepthTexture=!0,this.flipY=!1,this.generateMipmaps=!1,this.compareFunction=null}copy(e){return super.copy(e),this.source=new Ki(Object.assign({},e.image)),this.compareFunction=e.compareFunction,this}toJSON(e){let t=super.toJSON(e);return t.compareFunction=this.compareFunction,t}},ks=class extends zn{constructor(e,t=dn,n=Mi,i,r,o=wt,a=wt,l,c=Un){let h={width:e,height:e,depth:1},u=[h,h,h,h,h,h];super(e,e,t,n,i,r,o,a,l,c),this.image=u,this.isCubeDepthTexture=!0,this.isCubeTexture=!0}get images(){return this.image}set images(e){this.image=e}},zs=class extends Vt{constructor(e=null){super(),this.sourceTexture=e,this.isExternalTexture=!0}copy(e){return super.copy(e),this.sourceTexture=e.sourceTexture,this}},ii=class s extends Et{constructor(e=1,t=1,n=1,i=1,r=1,o=1){super(),this.type="BoxGeometry",this.parameters={width:e,height:t,depth:n,widthSegments:i,heightSegments:r,depthSegments:o};let a=this;i=Math.floor(i),r=Math.floor(r),o=Math.floor(o);let l=[],c=[],h=[],u=[],f=0,d=0;g("z","y","x",-1,-1,n,t,e,o,r,0),g("z","y","x",1,-1,n,t,-e,o,r,1),g("x","z","y",1,1,e,n,t,i,o,2),g("x","z","y",1,-1,e,n,-t,i,o,3),g("x","y","z",1,-1,e,t,n,i,r,4),g("x","y","z",-1,-1,e,t,-n,i,r,5),this.setIndex(l),this.setAttribute("position",new nt(c,3)),this.setAttribute("normal",new nt(h,3)),this.setAttribute("uv",new nt(u,2));function g(x,p,m,b,T,E,M,w,y,S,I){let R=E/y,N=M/S,O=E/2,D=M/2,P=w/2,V=y+1,W=S+1,G=0,ee=0,X=new U;for(let Q=0;Q<W;Q++){let te=Q*N-D;for(let Me=0;Me<V;Me++){let Fe=Me*R-O;X[x]=Fe*b,X[p]=te*T,X[m]=P,c.push(X.x,X.y,X.z),X[x]=0,X[p]=0,X[m]=w>0?1:-1,h.push(X.x,X.y,X.z),u.push(Me/y),u.push(1-Q/S),G+=1}}for(let Q=0;Q<S;Q++)for(let te=0;te<y;te++){let Me=f+te+V*Q,Fe=f+te+V*(Q+1),J=f+(te+1)+V*(Q+1),me=f+(te+1)+V*Q;l.push(Me,Fe,me),l.push(Fe,J,me),ee+=6}a.addGroup(d,ee,I),d+=ee,f+=G}}copy(e){return super.copy(e),this.parameters=Object.assign({},e.parameters),this}static fromJSON(e){return new s(e.width,e.height,e.depth,e.widthSegments,e.heightSegments,e.depthSegments)}},Vs=class s extends Et{constructor(e=1,t=1,n=4,i=8,r=1){super(),this.type="CapsuleGeometry",this.parameters={radius:e,height:t,capSegments:n,radialSegments:i,heightSegments:r},t=Math.max(0,t),n=Math.max(1,Math.floor(n)),i=Math.max(3,Math.floor(i)),r=Math.max(1,Math.floor(r));let o=[],a=[],l=[],c=[],h=t/2,u=Math.PI/2*e,f=t,d=2*u+f,g=n*2+r,x=i+1,p=new U,m=new U;for(let b=0;b<=g;b++){let T=0,E=0,M=0,w=0;if(b<=n){let I=b/n,R=I*Math.PI/2;E=-h-e*Math.cos(R),M=e*Math.sin(R),w=-e*Math.cos(R),T=I*u}else if(b<=n+r){let I=(b-n)/r;E=-h+I*t,M=e,w=0,T=u+I*f}else{let I=(b-n-r)/n,R=I*Math.PI/2;E=h+e*Math.sin(R),M=e*Math.cos(R),w=e*Math.sin(R),T=u+f+I*u}let y=Math.max(0,Math.min(1,T/d)),S=0;b===0?S=.5/i:b===g&&(S=-.5/i);for(let I=0;I<=i;I++){let R=I/i,N=R*Math.PI*2,O=Math.sin(N),D=Math.cos(N);m.x=-M*D,m.y=E,m.z=M*O,a.push(m.x,m.y,m.z),p.set(-M*D,w,M*O),p.normalize(),l.push(p.x,p.y,p.z),c.push(R+S,y)}if(b>0){let I=(b-1)*x;for(let R=0;R<i;R++){let N=I+R,O=I+R+1,D=b*x+R,P=b*x+R+1;o.push(N,O,D),o.push(O,P,D)}}}this.setIndex(o),this.setAttribute("position",new nt(a,3)),this.setAttribute("normal",new nt(l,3)),this.setAttribute("uv",new nt(c,2))}copy(e){return super.copy(e),this.parameters=Object.assign({},e.parameters),this}static fromJSON(e){return new s(e.radius,e.height,e.capSegments,e.radialSegments,e.heightSegments)}};var si=class s extends Et{constructor(e=1,t=1,n=1,i=32,r=1,o=!1,a=0,l=Math.PI*2){super(),this.type="CylinderGeometry",this.parameters={radiusTop:e,radiusBottom:t,height:n,radialSegments:i,heightSegments:r,openEnded:o,thetaStart:a,thetaLength:l};let c=this;i=Math.floor(i),r=Math.floor(r);let h=[],u=[],f=[],d=[],g=0,x=[],p=n/2,m=0;b(),o===!1&&(e>0&&T(!0),t>0&&T(!1)),this.setIndex(h),this.setAttribute("position",new nt(u,3)),this.setAttribute("normal",new nt(f,3)),this.setAttribute("uv",new nt(d,2));function b(){let E=new U,M=new U,w=0,y=(t-e)/n;for(let S=0;S<=r;S++){let I=[],R=S/r,N=R*(t-e)+e;for(let O=0;O<=i;O++){let D=O/i,P=D*l+a,V=Math.sin(P),W=Math.cos(P);M.x=N*V,M.y=-R*n+p,M.z=N*W,u.push(M.x,M.y,M.z),E.set(V,y,W).normalize(),f.push(E.x,E.y,E.z),d.push(D,1-R),I.push(g++)}x.push(I)}for(let S=0;S<i;S++)for(let I=0;I<r;I++){let R=x[I][S],N=x[I+1][S],O=x[I+1][S+1],D=x[I][S+1];(e>0||I!==0)&&(h.push(R,N,D),w+=3),(t>0||I!==r-1)&&(h.push(N,O,D),w+=3)}c.addGroup(m,w,0),m+=w}function T(E){let M=g,w=new Be,y=new U,S=0,I=E===!0?e:t,R=E===!0?1:-1;for(let O=1;O<=i;O++)u.push(0,p*R,0),f.push(0,R,0),d.push(.5,.5),g++;let N=g;for(let O=0;O<=i;O++){let P=O/i*l+a,V=Math.cos(P),W=Math.sin(P);y.x=I*W,y.y=p*R,y.z=I*V,u.push(y.x,y.y,y.z),f.push(0,R,0),w.x=V*.5+.5,w.y=W*.5*R+.5,d.push(w.x,w.y),g++}for(let O=0;O<i;O++){let D=M+O,P=N+O;E===!0?h.push(P,P+1,D):h.push(P+1,P,D),S+=3}c.addGroup(m,S,E===!0?1:2),m+=S}}copy(e){return super.copy(e),this.parameters=Object.assign({},e.parameters),this}static fromJSON(e){return new s(e.radiusTop,e.radiusBottom,e.height,e.radialSegments,e.heightSegments,e.openEnded,e.thetaStart,e.thetaLength)}},Gs=class s extends si{constructor(e=1,t=1,n=32,i=1,r=!1,o=0,a=Math.PI*2){super(0,e,t,n,i,r,o,a),this.type="ConeGeometry",this.parameters={radius:e,height:t,radialSegments:n,heightSegments:i,openEnded:r,thetaStart:o,thetaLength:a}}static fromJSON(e){return new s(e.radius,e.height,e.radialSegments,e.heightSegments,e.openEnded,e.thetaStart,e.thetaLength)}};var io=new U,so=new U,jl=new U,ro=new Nn,Hs=class extends Et{constructor(e=null,t=1){if(super(),this.type="EdgesGeometry",this.parameters={geometry:e,thresholdAngle:t},e!==null){let i=Math.pow(10,4),r=Math.cos(uo*t),o=e.getIndex(),a=e.getAttribute("position"),l=o?o.count:a.count,c=[0,0,0],h=["a","b","c"],u=new Array(3),f=new Map,d=[];for(let g=0;g<l;g+=3){o?(c[0]=o.getX(g),c[1]=o.getX(g+1),c[2]=o.getX(g+2)):(c[0]=g,c[1]=g+1,c[2]=g+2);let{a:x,b:p,c:m}=ro;if(x.fromBufferAttribute(a,c[0]),p.fromBufferAttribute(a,c[1]),m.fromBufferAttribute(a,c[2]),ro.getNormal(jl),u[0]=`${Math.round(x.x*i)},${Math.round(x.y*i)},${Math.round(x.z*i)}`,u[1]=`${Math.round(p.x*i)},${Math.round(p.y*i)},${Math.round(p.z*i)}`,u[2]=`${Math.round(m.x*i)},${Math.round(m.y*i)},${Math.round(m.z*i)}`,!(u[0]===u[1]||u[1]===u[2]||u[2]===u[0]))for(let b=0;b<3;b++){let T=(b+1)%3,E=u[b],M=u[T],w=ro[h[b]],y=ro[h[T]],S=`${E}_${M}`,I=`${M}_${E}`,R=f.get(I);R?(jl.dot(R.normal)<=r&&(d.push(w.x,w.y,w.z),d.push(y.x,y.y,y.z)),f.set(I,null)):f.has(S)||f.set(S,{index0:c[b],index1:c[T],normal:jl.clone()})}}for(let g of f.values())if(g){let{index0:x,index1:p}=g;io.fromBufferAttribute(a,x),so.fromBufferAttribute(a,p),d.push(io.x,io.y,io.z),d.push(so.x,so.y,so.z)}this.setAttribute("position",new nt(d,3))}}copy(e){return super.copy(e),this.parameters=Object.assign({},e.parameters),this}};var Vn=class s extends Et{constructor(e=1,t=1,n=1,i=1){super(),this.type="PlaneGeometry",this.parameters={width:e,height:t,widthSegments:n,heightSegments:i};let r=e/2,o=t/2,a=Math.floor(n),l=Math.floor(i),c=a+1,h=l+1,u=e/a,f=t/l,d=[],g=[],x=[],p=[];for(let m=0;m<h;m++){let b=m*f-o;for(let T=0;T<c;T++){let E=T*u-r;g.push(E,-b,0),x.push(0,0,1),p.push(T/a),p.push(1-m/l)}}for(let m=0;m<l;m++)for(let b=0;b<a;b++){let T=b+c*m,E=b+c*(m+1),M=b+1+c*(m+1),w=b+1+c*m;d.push(T,E,w),d.push(E,M,w)}this.setIndex(d),this.setAttribute("position",new nt(g,3)),this.setAttribute("normal",new nt(x,3)),this.setAttribute("uv",new nt(p,2))}copy(e){return super.copy(e),this.parameters=Object.assign({},e.parameters),this}static fromJSON(e){return new s(e.width,e.height,e.widthSegments,e.heightSegments)}};var sn=class s extends Et{constructor(e=1,t=32,n=16,i=0,r=Math.PI*2,o=0,a=Math.PI){super(),this.type="SphereGeometry",this.parameters={radius:e,widthSegments:t,heightSegments:n,phiStart:i,phiLength:r,thetaStart:o,thetaLength:a},t=Math.max(3,Math.floor(t)),n=Math.max(2,Math.floor(n));let l=Math.min(o+a,Math.PI),c=0,h=[],u=new U,f=new U,d=[],g=[],x=[],p=[];for(let m=0;m<=n;m++){let b=[],T=m/n,E=o+T*a,M=e*Math.cos(E),w=Math.sqrt(e*e-M*M),y=0;m===0&&o===0?y=.5/t:m===n&&l===Math.PI&&(y=-.5/t);for(let S=0;S<=t;S++){let I=S/t,R=i+I*r;u.x=-w*Math.cos(R),u.y=M,u.z=w*Math.sin(R),g.push(u.x,u.y,u.z),f.copy(u).normalize(),x.push(f.x,f.y,f.z),p.push(I+y,1-T),b.push(c++)}h.push(b)}for(let m=0;m<n;m++)for(let b=0;b<t;b++){let T=h[m][b+1],E=h[m][b],M=h[m+1][b],w=h[m+1][b+1];(m!==0||o>0)&&d.push(T,E,w),(m!==n-1||l<Math.PI)&&d.push(E,M,w)}this.setIndex(d),this.setAttribute("position",new nt(g,3)),this.setAttribute("normal",new nt(x,3)),this.setAttribute("uv",new nt(p,2))}copy(e){return super.copy(e),this.parameters=Object.assign({},e.parameters),this}static fromJSON(e){return new s(e.radius,e.widthSegments,e.heightSegments,e.phiStart,e.phiLength,e.thetaStart,e.thetaLength)}};var Ws=class extends Sn{constructor(e){super(),this.isShadowMaterial=!0,this.type="ShadowMaterial",this.color=new Ie(0),this.transparent=!0,this.fog=!0,this.setValues(e)}copy(e){return super.copy(e),this.color.copy(e.color),this.fog=e.fog,this}};function wi(s){let e={};for(let t in s){e[t]={};for(let n in s[t]){let i=s[t][n];if(su(i))i.isRenderTargetTexture?(Ce("UniformsUtils: Textures of render targets cannot be cloned via cloneUniforms() or mergeUniforms()."),e[t][n]=null):e[t][n]=i.clone();else if(Array.isArray(i))if(su(i[0])){let r=[];for(let o=0,a=i.length;o<a;o++)r[o]=i[o].clone();e[t][n]=r}else e[t][n]=i.slice();else e[t][n]=i}}return e}function Ft(s){let e={};for(let t=0;t<s.length;t++){let n=wi(s[t]);for(let i in n)e[i]=n[i]}return e}function su(s){return s&&(s.isColor||s.isMatrix3||s.isMatrix4||s.isVector2||s.isVector3||s.isVector4||s.isTexture||s.isQuaternion)}function bp(s){let e=[];for(let t=0;t<s.length;t++)e.push(s[t].clone());return e}function Dc(s){let e=s.getRenderTarget();return e===null?s.outputColorSpace:e.isXRRenderTarget===!0?e.texture.colorSpace:Xe.workingColorSpace}var Ju={clone:wi,merge:Ft},Mp=`void main(){
gl_Position=projectionMatrix*modelViewMatrix*vec4(position,1.0);
}`,Sp=`void main(){
gl_FragColor=vec4(1.0,0.0,0.0,1.0);
}`,Dt=class extends Sn{constructor(e){super(),this.isShaderMaterial=!0,this.type="ShaderMaterial",this.defines={},this.uniforms={},this.uniformsGroups=[],this.vertexShader=Mp,this.fragmentShader=Sp,this.linewidth=1,this.wireframe=!1,this.wireframeLinewidth=1,this.fog=!1,this.lights=!1,this.clipping=!1,this.forceSinglePass=!0,this.extensions={clipCullDistance:!1,multiDraw:!1},this.defaultAttributeValues={color:[1,1,1],uv:[0,0],uv1:[0,0]},this.index0AttributeName=void 0,this.uniformsNeedUpdate=!1,this.glslVersion=null,e!==void 0&&this.setValues(e)}copy(e){return super.copy(e),this.fragmentShader=e.fragmentShader,this.vertexShader=e.vertexShader,this.uniforms=wi(e.uniforms),this.uniformsGroups=bp(e.uniformsGroups),this.defines=Object.assign({},e.defines),this.wireframe=e.wireframe,this.wireframeLinewidth=e.wireframeLinewidth,this.fog=e.fog,this.lights=e.lights,this.clipping=e.clipping,this.extensions=Object.assign({},e.extensions),this.glslVersion=e.glslVersion,this.defaultAttributeValues=Object.assign({},e.defaultAttributeValues),this.index0AttributeName=e.index0AttributeName,this.uniformsNeedUpdate=e.uniformsNeedUpdate,this}toJSON(e){let t=super.toJSON(e);t.glslVersion=this.glslVersion,t.uniforms={};for(let i in this.uniforms){let o=this.uniforms[i].value;o&&o.isTexture?t.uniforms[i]={type:"t",value:o.toJSON(e).uuid}:o&&o.isColor?t.uniforms[i]={type:"c",value:o.getHex()}:o&&o.isVector2?t.uniforms[i]={type:"v2",value:o.toArray()}:o&&o.isVector3?t.uniforms[i]={type:"v3",value:o.toArray()}:o&&o.isVector4?t.uniforms[i]={type:"v4",value:o.toArray()}:o&&o.isMatrix3?t.uniforms[i]={type:"m3",value:o.toArray()}:o&&o.isMatrix4?t.uniforms[i]={type:"m4",value:o.toArray()}:t.uniforms[i]={value:o}}Object.keys(this.defines).length>0&&(t.defines=this.defines),t.vertexShader=this.vertexShader,t.fragmentShader=this.fragmentShader,t.lights=this.lights,t.clipping=this.clipping;let n={};for(let i in this.extensions)this.extensions[i]===!0&&(n[i]=!0);return Object.keys(n).length>0&&(t.extensions=n),t}fromJSON(e,t){if(super.fromJSON(e,t),e.uniforms!==void 0)for(let n in e.uniforms){let i=e.uniforms[n];switch(this.uniforms[n]={},i.type){case"t":this.uniforms[n].value=t[i.value]||null;break;case"c":this.uniforms[n].value=new Ie().setHex(i.value);break;case"v2":this.uniforms[n].value=new Be().fromArray(i.value);break;case"v3":this.uniforms[n].value=new U().fromArray(i.value);break;case"v4":this.uniforms[n].value=new at().fromArray(i.value);break;case"m3":this.uniforms[n].value=new Ne().fromArray(i.value);break;case"m4":this.uniforms[n].value=new je().fromArray(i.value);break;default:this.uniforms[n].value=i.value}}if(e.defines!==void 0&&(this.defines=e.defines),e.vertexShader!==void 0&&(this.vertexShader=e.vertexShader),e.fragmentShader!==void 0&&(this.fragmentShader=e.fragmentShader),e.glslVersion!==void 0&&(this.glslVersion=e.glslVersion),e.extensions!==void 0)for(let n in e.extensions)this.extensions[n]=e.extensions[n];return e.lights!==void 0&&(this.lights=e.lights),e.clipping!==void 0&&(this.clipping=e.clipping),this}},Lo=class extends Dt{constructor(e){super(e),this.isRawShaderMaterial=!0,this.type="RawShaderMaterial"}};var ts=class extends Sn{constructor(e){super(),this.isMeshLambertMaterial=!0,this.type="MeshLambertMaterial",this.color=new Ie(16777215),this.map=null,this.lightMap=null,this.lightMapIntensity=1,this.aoMap=null,this.aoMapIntensity=1,this.emissive=new Ie(0),this.emissiveIntensity=1,this.emissiveMap=null,this.bumpMap=null,this.bumpScale=1,this.normalMap=null,this.normalMapType=Na,this.normalScale=new Be(1,1),this.displacementMap=null,this.displacementScale=1,this.displacementBias=0,this.specularMap=null,this.alphaMap=null,this.envMap=null,this.envMapRotation=new On,this.combine=Yo,this.reflectivity=1,this.envMapIntensity=1,this.refractionRatio=.98,this.wireframe=!1,this.wireframeLinewidth=1,this.wireframeLinecap="round",this.wireframeLinejoin="round",this.flatShading=!1,this.fog=!0,this.setValues(e)}copy(e){return super.copy(e),this.color.copy(e.color),this.map=e.map,this.lightMap=e.lightMap,this.lightMapIntensity=e.lightMapIntensity,this.aoMap=e.aoMap,this.aoMapIntensity=e.aoMapIntensity,this.emissive.copy(e.emissive),this.emissiveMap=e.emissiveMap,this.emissiveIntensity=e.emissiveIntensity,this.bumpMap=e.bumpMap,this.bumpScale=e.bumpScale,this.normalMap=e.normalMap,this.normalMapType=e.normalMapType,this.normalScale.copy(e.normalScale),this.displacementMap=e.displacementMap,this.displacementScale=e.displacementScale,this.displacementBias=e.displacementBias,this.specularMap=e.specularMap,this.alphaMap=e.alphaMap,this.envMap=e.envMap,this.envMapRotation.copy(e.envMapRotation),this.combine=e.combine,this.reflectivity=e.reflectivity,this.envMapIntensity=e.envMapIntensity,this.refractionRatio=e.refractionRatio,this.wireframe=e.wireframe,this.wireframeLinewidth=e.wireframeLinewidth,this.wireframeLinecap=e.wireframeLinecap,this.wireframeLinejoin=e.wireframeLinejoin,this.flatShading=e.flatShading,this.fog=e.fog,this}},No=class extends Sn{constructor(e){super(),this.isMeshDepthMaterial=!0,this.type="MeshDepthMaterial",this.depthPacking=Fu,this.map=null,this.alphaMap=null,this.displacementMap=null,this.displacementScale=1,this.displacementBias=0,this.wireframe=!1,this.wireframeLinewidth=1,this.setValues(e)}copy(e){return super.copy(e),this.depthPacking=e.depthPacking,this.map=e.map,this.alphaMap=e.alphaMap,this.displacementMap=e.displacementMap,this.displacementScale=e.displacementScale,this.displacementBias=e.displacementBias,this.wireframe=e.wireframe,this.wireframeLinewidth=e.wireframeLinewidth,this}},Do=class extends Sn{constructor(e){super(),this.isMeshDistanceMaterial=!0,this.type="MeshDistanceMaterial",this.map=null,this.alphaMap=null,this.displacementMap=null,this.displacementScale=1,this.displacementBias=0,this.setValues(e)}copy(e){return super.copy(e),this.map=e.map,this.alphaMap=e.alphaMap,this.displacementMap=e.displacementMap,this.displacementScale=e.displacementScale,this.displacementBias=e.displacementBias,this}};function Wi(s,e){return!s||s.constructor===e?s:typeof e.BYTES_PER_ELEMENT=="number"?new e(s):Array.prototype.slice.call(s)}function oo(s){return s!==void 0&&s.inTangents!==void 0&&s.outTangents!==void 0}var ri=class{constructor(e,t,n,i){this.parameterPositions=e,this._cachedIndex=0,this.resultBuffer=i!==void 0?i:new t.constructor(n),this.sampleValues=t,this.valueSize=n,this.settings=null,this.DefaultSettings_={}}evaluate(e){let t=this.parameterPositions,n=this._cachedIndex,i=t[n],r=t[n-1];n:{e:{let o;t:{i:if(!(e<i)){for(let a=n+2;;){if(i===void 0){if(e<r)break i;return n=t.length,this._cachedIndex=n,this.copySampleValue_(n-1)}if(n===a)break;if(r=i,i=t[++n],e<i)break e}o=t.length;break t}if(!(e>=r)){let a=t[1];e<a&&(n=2,r=a);for(let l=n-2;;){if(r===void 0)return this._cachedIndex=0,this.copySampleValue_(0);if(n===l)break;if(i=r,r=t[--n-1],e>=r)break e}o=n,n=0;break t}break n}for(;n<o;){let a=n+o>>>1;e<t[a]?o=a:n=a+1}if(i=t[n],r=t[n-1],r===void 0)return this._cachedIndex=0,this.copySampleValue_(0);if(i===void 0)return n=t.length,this._cachedIndex=n,this.copySampleValue_(n-1)}this._cachedIndex=n,this.intervalChanged_(n,r,i)}return this.interpolate_(n,r,e,i)}getSettings_(){return this.settings||this.DefaultSettings_}copySampleValue_(e){let t=this.resultBuffer,n=this.sampleValues,i=this.valueSize,r=e*i;for(let o=0;o!==i;++o)t[o]=n[r+o];return t}interpolate_(){throw new Error("THREE.Interpolant: Call to abstract method.")}intervalChanged_(){}},Fo=class extends ri{constructor(e,t,n,i){super(e,t,n,i),this._weightPrev=-0,this._offsetPrev=-0,this._weightNext=-0,this._offsetNext=-0,this.DefaultSettings_={endingStart:tc,endingEnd:tc}}intervalChanged_(e,t,n){let i=this.parameterPositions,r=e-2,o=e+1,a=i[r],l=i[o];if(a===void 0)switch(this.getSettings_().endingStart){case nc:r=e,a=2*t-n;break;case ic:r=i.length-2,a=t+i[r]-i[r+1];break;default:r=e,a=n}if(l===void 0)switch(this.getSettings_().endingEnd){case nc:o=e,l=2*n-t;break;case ic:o=1,l=n+i[1]-i[0];break;default:o=e-1,l=t}let c=(n-t)*.5,h=this.valueSize;this._weightPrev=c/(t-a),this._weightNext=c/(l-n),this._offsetPrev=r*h,this._offsetNext=o*h}interpolate_(e,t,n,i){let r=this.resultBuffer,o=this.sampleValues,a=this.valueSize,l=e*a,c=l-a,h=this._offsetPrev,u=this._offsetNext,f=this._weightPrev,d=this._weightNext,g=(n-t)/(i-t),x=g*g,p=x*g,m=-f*p+2*f*x-f*g,b=(1+f)*p+(-1.5-2*f)*x+(-.5+f)*g+1,T=(-1-d)*p+(1.5+d)*x+.5*g,E=d*p-d*x;for(let M=0;M!==a;++M)r[M]=m*o[h+M]+b*o[c+M]+T*o[l+M]+E*o[u+M];return r}},Uo=class extends ri{constructor(e,t,n,i){super(e,t,n,i)}interpolate_(e,t,n,i){let r=this.resultBuffer,o=this.sampleValues,a=this.valueSize,l=e*a,c=l-a,h=(n-t)/(i-t),u=1-h;for(let f=0;f!==a;++f)r[f]=o[c+f]*u+o[l+f]*h;return r}},Oo=class extends ri{constructor(e,t,n,i){super(e,t,n,i)}interpolate_(e){return this.copySampleValue_(e-1)}},Bo=class extends ri{interpolate_(e,t,n,i){let r=this.resultBuffer,o=this.sampleValues,a=this.valueSize,l=e*a,c=l-a,h=this.inTangents,u=this.outTangents;if(!h||!u){let g=(n-t)/(i-t),x=1-g;for(let p=0;p!==a;++p)r[p]=o[c+p]*x+o[l+p]*g;return r}let f=a*2,d=e-1;for(let g=0;g!==a;++g){let x=o[c+g],p=o[l+g],m=d*f+g*2,b=u[m],T=u[m+1],E=e*f+g*2,M=h[E],w=h[E+1],y=Ep(n,t,b,M,i);r[g]=Ku(y,x,T,w,p)}return r}};function Ku(s,e,t,n,i){let r=1-s;return r*r*r*e+3*r*r*s*t+3*r*s*s*n+s*s*s*i}function wp(s,e,t,n,i){let r=1-s;return 3*r*r*(t-e)+6*r*s*(n-t)+3*s*s*(i-n)}function Ep(s,e,t,n,i){let r=(s-e)/(i-e);for(let o=0;o<8;o++){let a=Ku(r,e,t,n,i)-s;if(Math.abs(a)<1e-10)break;let l=wp(r,e,t,n,i);if(Math.abs(l)<1e-10)break;r=Math.max(0,Math.min(1,r-a/l))}return r}var Zt=class{constructor(e,t,n,i){if(e===void 0)throw new Error("THREE.KeyframeTrack: track name is undefined");if(t===void 0||t.length===0)throw new Error("THREE.KeyframeTrack: no keyframes in track named "+e);this.name=e,this.times=Wi(t,this.TimeBufferType),this.values=Wi(n,this.ValueBufferType),this.setInterpolation(i||this.DefaultInterpolation)}static toJSON(e){let t=e.constructor,n;if(t.toJSON!==this.toJSON)n=t.toJSON(e);else{n={name:e.name,times:Wi(e.times,Array),values:Wi(e.values,Array)};let i=e.getInterpolation();i!==e.DefaultInterpolation&&(n.interpolation=i),oo(e.settings)&&(n.settings={inTangents:Wi(e.settings.inTangents,Array),outTangents:Wi(e.settings.outTangents,Array)})}return n.type=e.ValueTypeName,n}InterpolantFactoryMethodDiscrete(e){return new Oo(this.times,this.values,this.getValueSize(),e)}InterpolantFactoryMethodLinear(e){return new Uo(this.times,this.values,this.getValueSize(),e)}InterpolantFactoryMethodSmooth(e){return new Fo(this.times,this.values,this.getValueSize(),e)}InterpolantFactoryMethodBezier(e){let t=new Bo(this.times,this.values,this.getValueSize(),e);return this.settings&&(t.inTangents=this.settings.inTangents,t.outTangents=this.settings.outTangents),t}setInterpolation(e){let t;switch(e){case Ts:t=this.InterpolantFactoryMethodDiscrete;break;case Mo:t=this.InterpolantFactoryMethodLinear;break;case co:t=this.InterpolantFactoryMethodSmooth;break;case ec:t=this.InterpolantFactoryMethodBezier;break}if(t===void 0){let n="unsupported interpolation for "+this.ValueTypeName+" keyframe track named "+this.name;if(this.createInterpolant===void 0)if(e!==this.DefaultInterpolation)this.setInterpolation(this.DefaultInterpolation);else throw new Error(n);return Ce("KeyframeTrack:",n),this}return this.createInterpolant=t,this}getInterpolation(){switch(this.createInterpolant){case this.InterpolantFactoryMethodDiscrete:return Ts;case this.InterpolantFactoryMethodLinear:return Mo;case this.InterpolantFactoryMethodSmooth:return co;case this.InterpolantFactoryMethodBezier:return ec}}getValueSize(){return this.values.length/this.times.length}shift(e){if(e!==0){let t=this.times;for(let n=0,i=t.length;n!==i;++n)t[n]+=e;oo(this.settings)&&(ru(this.settings.inTangents,e),ru(this.settings.outTangents,e))}return this}scale(e){if(e!==1){let t=this.times;for(let n=0,i=t.length;n!==i;++n)t[n]*=e;oo(this.settings)&&(ou(this.settings.inTangents,e),ou(this.settings.outTangents,e))}return this}trim(e,t){let n=this.times,i=n.length,r=0,o=i-1;for(;r!==i&&n[r]<e;)++r;for(;o!==-1&&n[o]>t;)--o;if(++o,r!==0||o!==i){r>=o&&(o=Math.max(o,1),r=o-1);let a=this.getValueSize();this.times=n.slice(r,o),this.values=this.values.slice(r*a,o*a)}return this}validate(){let e=!0,t=this.getValueSize();t-Math.floor(t)!==0&&(Le("KeyframeTrack: Invalid value size in track.",this),e=!1);let n=this.times,i=this.values,r=n.length;r===0&&(Le("KeyframeTrack: Track is empty.",this),e=!1);let o=null;for(let a=0;a!==r;a++){let l=n[a];if(typeof l=="number"&&isNaN(l)){Le("KeyframeTrack: Time is not a valid number.",this,a,l),e=!1;break}if(o!==null&&o>l){Le("KeyframeTrack: Out of order keys.",this,a,l,o),e=!1;break}o=l}if(i!==void 0&&Qf(i))for(let a=0,l=i.length;a!==l;++a){let c=i[a];if(isNaN(c)){Le("KeyframeTrack: Value is not a valid number.",this,a,c),e=!1;break}}return e}optimize(){let e=this.times.slice(),t=this.values.slice(),n=this.getValueSize(),i=this.getInterpolation()===co,r=e.length-1,o=1;for(let a=1;a<r;++a){let l=!1,c=e[a],h=e[a+1];if(c!==h&&(a!==1||c!==e[0]))if(i)l=!0;else{let u=a*n,f=u-n,d=u+n;for(let g=0;g!==n;++g){let x=t[u+g];if(x!==t[f+g]||x!==t[d+g]){l=!0;break}}}if(l){if(a!==o){e[o]=e[a];let u=a*n,f=o*n;for(let d=0;d!==n;++d)t[f+d]=t[u+d]}++o}}if(r>0){e[o]=e[r];for(let a=r*n,l=o*n,c=0;c!==n;++c)t[l+c]=t[a+c];++o}return o!==e.length?(this.times=e.slice(0,o),this.values=t.slice(0,o*n)):(this.times=e,this.values=t),this}clone(){let e=this.times.slice(),t=this.values.slice(),n=this.constructor,i=new n(this.name,e,t);return i.createInterpolant=this.createInterpolant,oo(this.settings)&&(i.settings={inTangents:this.settings.inTangents.slice(),outTangents:this.settings.outTangents.slice()}),i}};function ru(s,e){for(let t=0,n=s.length;t!==n;t+=2)s[t]+=e}function ou(s,e){for(let t=0,n=s.length;t!==n;t+=2)s[t]*=e}Zt.prototype.ValueTypeName="";Zt.prototype.TimeBufferType=Float32Array;Zt.prototype.ValueBufferType=Float32Array;Zt.prototype.DefaultInterpolation=Mo;var oi=class extends Zt{constructor(e,t,n){super(e,t,n)}};oi.prototype.ValueTypeName="bool";oi.prototype.ValueBufferType=Array;oi.prototype.DefaultInterpolation=Ts;oi.prototype.InterpolantFactoryMethodLinear=void 0;oi.prototype.InterpolantFactoryMethodSmooth=void 0;var ko=class extends Zt{constructor(e,t,n,i){super(e,t,n,i)}};ko.prototype.ValueTypeName="color";var zo=class extends Zt{constructor(e,t,n,i){super(e,t,n,i)}};zo.prototype.ValueTypeName="number";var Vo=class extends ri{constructor(e,t,n,i){super(e,t,n,i)}interpolate_(e,t,n,i){let r=this.resultBuffer,o=this.sampleValues,a=this.valueSize,l=(n-t)/(i-t),c=e*a;for(let h=c+a;c!==h;c+=4)nn.slerpFlat(r,0,o,c-a,o,c,l);return r}},Xs=class extends Zt{constructor(e,t,n,i){super(e,t,n,i)}InterpolantFactoryMethodLinear(e){return new Vo(this.times,this.values,this.getValueSize(),e)}};Xs.prototype.ValueTypeName="quaternion";Xs.prototype.InterpolantFactoryMethodSmooth=void 0;var ai=class extends Zt{constructor(e,t,n){super(e,t,n)}};ai.prototype.ValueTypeName="string";ai.prototype.ValueBufferType=Array;ai.prototype.DefaultInterpolation=Ts;ai.prototype.InterpolantFactoryMethodLinear=void 0;ai.prototype.InterpolantFactoryMethodSmooth=void 0;var Go=class extends Zt{constructor(e,t,n,i){super(e,t,n,i)}};Go.prototype.ValueTypeName="vector";var Ho=class{constructor(e,t,n){let i=this,r=!1,o=0,a=0,l,c=[];this.onStart=void 0,this.onLoad=e,this.onProgress=t,this.onError=n,this._abortController=null,this.itemStart=function(h){a++,r===!1&&i.onStart!==void 0&&i.onStart(h,o,a),r=!0},this.itemEnd=function(h){o++,i.onProgress!==void 0&&i.onProgress(h,o,a),o===a&&(r=!1,i.onLoad!==void 0&&i.onLoad())},this.itemError=function(h){i.onError!==void 0&&i.onError(h)},this.resolveURL=function(h){return h=h.normalize("NFC"),l?l(h):h},this.setURLModifier=function(h){return l=h,this},this.addHandler=function(h,u){return c.push(h,u),this},this.removeHandler=function(h){let u=c.indexOf(h);return u!==-1&&c.splice(u,2),this},this.getHandler=function(h){for(let u=0,f=c.length;u<f;u+=2){let d=c[u],g=c[u+1];if(d.global&&(d.lastIndex=0),d.test(h))return g}return null},this.abort=function(){return this.abortController.abort(),this._abortController=null,this}}get abortController(){return this._abortController||(this._abortController=new AbortController),this._abortController}},ju=new Ho,Wo=class{constructor(e){this.manager=e!==void 0?e:ju,this.crossOrigin="anonymous",this.withCredentials=!1,this.path="",this.resourcePath="",this.requestHeader={},this.priority="auto",this.cache="default",typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("observe",{detail:this}))}load(){}loadAsync(e,t){let n=this;return new Promise(function(i,r){n.load(e,i,t,r)})}parse(){}setCrossOrigin(e){return this.crossOrigin=e,this}setWithCredentials(e){return this.withCredentials=e,this}setPath(e){return this.path=e,this}setResourcePath(e){return this.resourcePath=e,this}setRequestHeader(e){return this.requestHeader=e,this}setPriority(e){return this.priority=e,this}setCache(e){return this.cache=e,this}abort(){return this}};Wo.DEFAULT_MATERIAL_NAME="__DEFAULT";var ns=class extends Rt{static registerNode(e){this.prototype._lightNode=e}constructor(e,t=1){super(),this.isLight=!0,this.type="Light",this.color=new Ie(e),this.intensity=t}copy(e,t){return super.copy(e,t),this.color.copy(e.color),this.intensity=e.intensity,this}toJSON(e){let t=super.toJSON(e);return t.object.color=this.color.getHex(),t.object.intensity=this.intensity,t}},qs=class extends ns{constructor(e,t,n){super(e,n),this.isHemisphereLight=!0,this.type="HemisphereLight",this.position.copy(Rt.DEFAULT_UP),this.updateMatrix(),this.groundColor=new Ie(t)}copy(e,t){return super.copy(e,t),this.groundColor.copy(e.groundColor),this}toJSON(e){let t=super.toJSON(e);return t.object.groundColor=this.groundColor.getHex(),t}},Ql=new je,au=new U,lu=new U,Xo=class{constructor(e){this.camera=e,this.intensity=1,this.bias=0,this.biasNode=null,this.normalBias=0,this.radius=1,this.blurSamples=8,this.mapSize=new Be(512,512),this.mapType=Ht,this.map=null,this.mapPass=null,this.matrix=new je,this.autoUpdate=!0,this.needsUpdate=!1,this._frustum=new ni,this._frameExtents=new Be(1,1),this._viewportCount=1,this._viewports=[new at(0,0,1,1)]}getViewportCount(){return this._viewportCount}getCamera(){return this.camera}getFrustum(){return this._frustum}updateMatrices(e){let t=this.camera;au.setFromMatrixPosition(e.matrixWorld),t.position.copy(au),lu.setFromMatrixPosition(e.target.matrixWorld),t.lookAt(lu),t.updateMatrixWorld(),this._updateMatrix(t,this.matrix,this._frustum)}_updateMatrix(e,t,n,i){Ql.multiplyMatrices(e.projectionMatrix,e.matrixWorldInverse),n.setFromProjectionMatrix(Ql,e.coordinateSystem,e.reversedDepth);let r=this._frameExtents,o=i?i.z/r.x:1,a=i?i.w/r.y:1,l=i?i.x/r.x:0,c=i?i.y/r.y:0;e.coordinateSystem===Zi||e.reversedDepth?t.set(.5*o,0,0,.5*o+l,0,.5*a,0,.5*a+c,0,0,1,0,0,0,0,1):t.set(.5*o,0,0,.5*o+l,0,.5*a,0,.5*a+c,0,0,.5,.5,0,0,0,1),t.multiply(Ql)}getViewport(e){return this._viewports[e]}getFrameExtents(){return this._frameExtents}dispose(){this.map&&this.map.dispose(),this.mapPass&&this.mapPass.dispose()}copy(e){return this.camera=e.camera.clone(),this.intensity=e.intensity,this.bias=e.bias,this.radius=e.radius,this.autoUpdate=e.autoUpdate,this.needsUpdate=e.needsUpdate,this.normalBias=e.normalBias,this.blurSamples=e.blurSamples,this.mapSize.copy(e.mapSize),this.mapType=e.mapType,this.biasNode=e.biasNode,this}clone(){return new this.constructor().copy(this)}toJSON(){let e={};return e.intensity=this.intensity,e.bias=this.bias,e.normalBias=this.normalBias,e.radius=this.radius,e.blurSamples=this.blurSamples,e.mapSize=this.mapSize.toArray(),e.mapType=this.mapType,e.camera=this.camera.toJSON(!1).object,delete e.camera.matrix,e}},ao=new U,lo=new nn,_n=new U,Ys=class extends Rt{constructor(){super(),this.isCamera=!0,this.type="Camera",this.matrixWorldInverse=new je,this.projectionMatrix=new je,this.projectionMatrixInverse=new je,this.coordinateSystem=tn,this._reversedDepth=!1}get reversedDepth(){return this._reversedDepth}copy(e,t){return super.copy(e,t),this.matrixWorldInverse.copy(e.matrixWorldInverse),this.projectionMatrix.copy(e.projectionMatrix),this.projectionMatrixInverse.copy(e.projectionMatrixInverse),this.coordinateSystem=e.coordinateSystem,this}getWorldDirection(e){return super.getWorldDirection(e).negate()}updateMatrixWorld(e){super.updateMatrixWorld(e),this.matrixWorld.decompose(ao,lo,_n),_n.x===1&&_n.y===1&&_n.z===1?this.matrixWorldInverse.copy(this.matrixWorld).invert():this.matrixWorldInverse.compose(ao,lo,_n.set(1,1,1)).invert()}updateWorldMatrix(e,t,n=!1){super.updateWorldMatrix(e,t,n),this.matrixWorld.decompose(ao,lo,_n),_n.x===1&&_n.y===1&&_n.z===1?this.matrixWorldInverse.copy(this.matrixWorld).invert():this.matrixWorldInverse.compose(ao,lo,_n.set(1,1,1)).invert()}clone(){return new this.constructor().copy(this)}},ei=new U,cu=new Be,hu=new Be,Ot=class extends Ys{constructor(e=50,t=1,n=.1,i=2e3){super(),this.isPerspectiveCamera=!0,this.type="PerspectiveCamera",this.fov=e,this.zoom=1,this.near=n,this.far=i,this.focus=10,this.aspect=t,this.view=null,this.filmGauge=35,this.filmOffset=0,this.updateProjectionMatrix()}copy(e,t){return super.copy(e,t),this.fov=e.fov,this.zoom=e.zoom,this.near=e.near,this.far=e.far,this.focus=e.focus,this.aspect=e.aspect,this.view=e.view===null?null:Object.assign({},e.view),this.filmGauge=e.filmGauge,this.filmOffset=e.filmOffset,this}setFocalLength(e){let t=.5*this.getFilmHeight()/e;this.fov=So*2*Math.atan(t),this.updateProjectionMatrix()}getFocalLength(){let e=Math.tan(uo*.5*this.fov);return .5*this.getFilmHeight()/e}getEffectiveFOV(){return So*2*Math.atan(Math.tan(uo*.5*this.fov)/this.zoom)}getFilmWidth(){return this.filmGauge*Math.min(this.aspect,1)}getFilmHeight(){return this.filmGauge/Math.max(this.aspect,1)}getViewBounds(e,t,n){ei.set(-1,-1,.5).applyMatrix4(this.projectionMatrixInverse),t.set(ei.x,ei.y).multiplyScalar(-e/ei.z),ei.set(1,1,.5).applyMatrix4(this.projectionMatrixInverse),n.set(ei.x,ei.y).multiplyScalar(-e/ei.z)}getViewSize(e,t){return this.getViewBounds(e,cu,hu),t.subVectors(hu,cu)}setViewOffset(e,t,n,i,r,o){this.aspect=e/t,this.view===null&&(this.view={enabled:!0,fullWidth:1,fullHeight:1,offsetX:0,offsetY:0,width:1,height:1}),this.view.enabled=!0,this.view.fullWidth=e,this.view.fullHeight=t,this.view.offsetX=n,this.view.offsetY=i,this.view.width=r,this.view.height=o,this.updateProjectionMatrix()}clearViewOffset(){this.view!==null&&(this.view.enabled=!1),this.updateProjectionMatrix()}updateProjectionMatrix(){let e=this.near,t=e*Math.tan(uo*.5*this.fov)/this.zoom,n=2*t,i=this.aspect*n,r=-.5*i,o=this.view;if(this.view!==null&&this.view.enabled){let l=o.fullWidth,c=o.fullHeight;r+=o.offsetX*i/l,t-=o.offsetY*n/c,i*=o.width/l,n*=o.height/c}let a=this.filmOffset;a!==0&&(r+=e*a/this.getFilmWidth()),this.projectionMatrix.makePerspective(r,r+i,t,t-n,e,this.far,this.coordinateSystem,this.reversedDepth),this.projectionMatrixInverse.copy(this.projectionMatrix).invert()}toJSON(e){let t=super.toJSON(e);return t.object.fov=this.fov,t.object.zoom=this.zoom,t.object.near=this.near,t.object.far=this.far,t.object.focus=this.focus,t.object.aspect=this.aspect,this.view!==null&&(t.object.view=Object.assign({},this.view)),t.object.filmGauge=this.filmGauge,t.object.filmOffset=this.filmOffset,t}};var $s=class extends Ys{constructor(e=-1,t=1,n=1,i=-1,r=.1,o=2e3){super(),this.isOrthographicCamera=!0,this.type="OrthographicCamera",this.zoom=1,this.view=null,this.left=e,this.right=t,this.top=n,this.bottom=i,this.near=r,this.far=o,this.updateProjectionMatrix()}copy(e,t){return super.copy(e,t),this.left=e.left,this.right=e.right,this.top=e.top,this.bottom=e.bottom,this.near=e.near,this.far=e.far,this.zoom=e.zoom,this.view=e.view===null?null:Object.assign({},e.view),this}setViewOffset(e,t,n,i,r,o){this.view===null&&(this.view={enabled:!0,fullWidth:1,fullHeight:1,offsetX:0,offsetY:0,width:1,height:1}),this.view.enabled=!0,this.view.fullWidth=e,this.view.fullHeight=t,this.view.offsetX=n,this.view.offsetY=i,this.view.width=r,this.view.height=o,this.updateProjectionMatrix()}clearViewOffset(){this.view!==null&&(this.view.enabled=!1),this.updateProjectionMatrix()}updateProjectionMatrix(){let e=(this.right-this.left)/(2*this.zoom),t=(this.top-this.bottom)/(2*this.zoom),n=(this.right+this.left)/2,i=(this.top+this.bottom)/2,r=n-e,o=n+e,a=i+t,l=i-t;if(this.view!==null&&this.view.enabled){let c=(this.right-this.left)/this.view.fullWidth/this.zoom,h=(this.top-this.bottom)/this.view.fullHeight/this.zoom;r+=c*this.view.offsetX,o=r+c*this.view.width,a-=h*this.view.offsetY,l=a-h*this.view.height}this.projectionMatrix.makeOrthographic(r,o,a,l,this.near,this.far,this.coordinateSystem,this.reversedDepth),this.projectionMatrixInverse.copy(this.projectionMatrix).invert()}toJSON(e){let t=super.toJSON(e);return t.object.zoom=this.zoom,t.object.left=this.left,t.object.right=this.right,t.object.top=this.top,t.object.bottom=this.bottom,t.object.near=this.near,t.object.far=this.far,this.view!==null&&(t.object.view=Object.assign({},this.view)),t}},sc=class extends Xo{constructor(){super(new $s(-5,5,5,-5,.5,500)),this.isDirectionalLightShadow=!0}},Zs=class extends ns{constructor(e,t){super(e,t),this.isDirectionalLight=!0,this.type="DirectionalLight",this.position.copy(Rt.DEFAULT_UP),this.updateMatrix(),this.target=new Rt,this.shadow=new sc}dispose(){super.dispose(),this.shadow.dispose()}copy(e){return super.copy(e),this.target=e.target.clone(),this.shadow=e.shadow.clone(),this}toJSON(e){let t=super.toJSON(e);return t.object.shadow=this.shadow.toJSON(),t.object.target=this.target.uuid,t}},Js=class extends ns{constructor(e,t){super(e,t),this.isAmbientLight=!0,this.type="AmbientLight"}};var Ks=class extends Et{constructor(){super(),this.isInstancedBufferGeometry=!0,this.type="InstancedBufferGeometry",this.instanceCount=1/0}copy(e){return super.copy(e),this.instanceCount=e.instanceCount,this}toJSON(){let e=super.toJSON();return e.instanceCount=this.instanceCount,e.isInstancedBufferGeometry=!0,e}};var Xi=-90,qi=1,is=class extends Rt{constructor(e,t,n){super(),this.type="CubeCamera",this.renderTarget=n,this.coordinateSystem=null,this.activeMipmapLevel=0;let i=new Ot(Xi,qi,e,t);i.layers=this.layers,this.add(i);let r=new Ot(Xi,qi,e,t);r.layers=this.layers,this.add(r);let o=new Ot(Xi,qi,e,t);o.layers=this.layers,this.add(o);let a=new Ot(Xi,qi,e,t);a.layers=this.layers,this.add(a);let l=new Ot(Xi,qi,e,t);l.layers=this.layers,this.add(l);let c=new Ot(Xi,qi,e,t);c.layers=this.layers,this.add(c)}updateCoordinateSystem(){let e=this.coordinateSystem,t=this.children.concat(),[n,i,r,o,a,l]=t;for(let c of t)this.remove(c);if(e===tn)n.up.set(0,1,0),n.lookAt(1,0,0),i.up.set(0,1,0),i.lookAt(-1,0,0),r.up.set(0,0,-1),r.lookAt(0,1,0),o.up.set(0,0,1),o.lookAt(0,-1,0),a.up.set(0,1,0),a.lookAt(0,0,1),l.up.set(0,1,0),l.lookAt(0,0,-1);else if(e===Zi)n.up.set(0,-1,0),n.lookAt(-1,0,0),i.up.set(0,-1,0),i.lookAt(1,0,0),r.up.set(0,0,1),r.lookAt(0,1,0),o.up.set(0,0,-1),o.lookAt(0,-1,0),a.up.set(0,-1,0),a.lookAt(0,0,1),l.up.set(0,-1,0),l.lookAt(0,0,-1);else throw new Error("THREE.CubeCamera.updateCoordinateSystem(): Invalid coordinate system: "+e);for(let c of t)this.add(c),c.updateMatrixWorld()}update(e,t){this.parent===null&&this.updateMatrixWorld();let{renderTarget:n,activeMipmapLevel:i}=this;this.coordinateSystem!==e.coordinateSystem&&(this.coordinateSystem=e.coordinateSystem,this.updateCoordinateSystem());let[r,o,a,l,c,h]=this.children,u=e.getRenderTarget(),f=e.getActiveCubeFace(),d=e.getActiveMipmapLevel(),g=e.xr.enabled;e.xr.enabled=!1;let x=n.texture.mipmapsAutoUpdate;n.texture.mipmapsAutoUpdate=!1;let p=!1;e.isWebGLRenderer===!0?p=e.state.buffers.depth.getReversed():p=e.reversedDepthBuffer,e.setRenderTarget(n,0,i),p&&e.autoClear===!1&&e.clearDepth(),e.render(t,r),e.setRenderTarget(n,1,i),p&&e.autoClear===!1&&e.clearDepth(),e.render(t,o),e.setRenderTarget(n,2,i),p&&e.autoClear===!1&&e.clearDepth(),e.render(t,a),e.setRenderTarget(n,3,i),p&&e.autoClear===!1&&e.clearDepth(),e.render(t,l),e.setRenderTarget(n,4,i),p&&e.autoClear===!1&&e.clearDepth(),e.render(t,c),n.texture.mipmapsAutoUpdate=x,e.setRenderTarget(n,5,i),p&&e.autoClear===!1&&e.clearDepth(),e.render(t,h),e.setRenderTarget(u,f,d),e.xr.enabled=g,n.texture.needsPMREMUpdate=!0}},qo=class extends Ot{constructor(e=[]){super(),this.isArrayCamera=!0,this.isMultiViewCamera=!1,this.cameras=e,this.perCameraFrustumCulled=!1}};var Fc="\\[\\]\\.:\\/",Ap=new RegExp("["+Fc+"]","g"),Uc="[^"+Fc+"]",Tp="[^"+Fc.replace("\\.","")+"]",Rp=/((?:WC+[\/:])*)/.source.replace("WC",Uc),Cp=/(WCOD+)?/.source.replace("WCOD",Tp),Pp=/(?:\.(WC+)(?:\[(.+)\])?)?/.source.replace("WC",Uc),Ip=/\.(WC+)(?:\[(.+)\])?/.source.replace("WC",Uc),Lp=new RegExp("^"+Rp+Cp+Pp+Ip+"$"),Np=["material","materials","bones","map"],rc=class{constructor(e,t,n){let i=n||st.parseTrackName(t);this._targetGroup=e,this._bindings=e.subscribe_(t,i)}getValue(e,t){this.bind();let n=this._targetGroup.nCachedObjects_,i=this._bindings[n];i!==void 0&&i.getValue(e,t)}setValue(e,t){let n=this._bindings;for(let i=this._targetGroup.nCachedObjects_,r=n.length;i!==r;++i)n[i].setValue(e,t)}bind(){let e=this._bindings;for(let t=this._targetGroup.nCachedObjects_,n=e.length;t!==n;++t)e[t].bind()}unbind(){let e=this._bindings;for(let t=this._targetGroup.nCachedObjects_,n=e.length;t!==n;++t)e[t].unbind()}},st=class s{constructor(e,t,n){this.path=t,this.parsedPath=n||s.parseTrackName(t),this.node=s.findNode(e,this.parsedPath.nodeName),this.rootNode=e,this.getValue=this._getValue_unbound,this.setValue=this._setValue_unbound}static create(e,t,n){return e&&e.isAnimationObjectGroup?new s.Composite(e,t,n):new s(e,t,n)}static sanitizeNodeName(e){return e.replace(/\s/g,"_").replace(Ap,"")}static parseTrackName(e){let t=Lp.exec(e);if(t===null)throw new Error("THREE.PropertyBinding: Cannot parse trackName: "+e);let n={nodeName:t[2],objectName:t[3],objectIndex:t[4],propertyName:t[5],propertyIndex:t[6]},i=n.nodeName&&n.nodeName.lastIndexOf(".");if(i!==void 0&&i!==-1){let r=n.nodeName.substring(i+1);Np.indexOf(r)!==-1&&(n.nodeName=n.nodeName.substring(0,i),n.objectName=r)}if(n.propertyName===null||n.propertyName.length===0)throw new Error("THREE.PropertyBinding: can not parse propertyName from trackName: "+e);return n}static findNode(e,t){if(t===void 0||t===""||t==="."||t===-1||t===e.name||t===e.uuid)return e;if(e.skeleton){let n=e.skeleton.getBoneByName(t);if(n!==void 0)return n}if(e.children){let n=function(r){for(let o=0;o<r.length;o++){let a=r[o];if(a.name===t||a.uuid===t)return a;let l=n(a.children);if(l)return l}return null},i=n(e.children);if(i)return i}return null}_getValue_unavailable(){}_setValue_unavailable(){}_getValue_direct(e,t){e[t]=this.targetObject[this.propertyName]}_getValue_array(e,t){let n=this.resolvedProperty;for(let i=0,r=n.length;i!==r;++i)e[t++]=n[i]}_getValue_arrayElement(e,t){e[t]=this.resolvedProperty[this.propertyIndex]}_getValue_toArray(e,t){this.resolvedProperty.toArray(e,t)}_setValue_direct(e,t){this.targetObject[this.propertyName]=e[t]}_setValue_direct_setNeedsUpdate(e,t){this.targetObject[this.propertyName]=e[t],this.targetObject.needsUpdate=!0}_setValue_direct_setMatrixWorldNeedsUpdate(e,t){this.targetObject[this.propertyName]=e[t],this.targetObject.matrixWorldNeedsUpdate=!0}_setValue_array(e,t){let n=this.resolvedProperty;for(let i=0,r=n.length;i!==r;++i)n[i]=e[t++]}_setValue_array_setNeedsUpdate(e,t){let n=this.resolvedProperty;for(let i=0,r=n.length;i!==r;++i)n[i]=e[t++];this.targetObject.needsUpdate=!0}_setValue_array_setMatrixWorldNeedsUpdate(e,t){let n=this.resolvedProperty;for(let i=0,r=n.length;i!==r;++i)n[i]=e[t++];this.targetObject.matrixWorldNeedsUpdate=!0}_setValue_arrayElement(e,t){this.resolvedProperty[this.propertyIndex]=e[t]}_setValue_arrayElement_setNeedsUpdate(e,t){this.resolvedProperty[this.propertyIndex]=e[t],this.targetObject.needsUpdate=!0}_setValue_arrayElement_setMatrixWorldNeedsUpdate(e,t){this.resolvedProperty[this.propertyIndex]=e[t],this.targetObject.matrixWorldNeedsUpdate=!0}_setValue_fromArray(e,t){this.resolvedProperty.fromArray(e,t)}_setValue_fromArray_setNeedsUpdate(e,t){this.resolvedProperty.fromArray(e,t),this.targetObject.needsUpdate=!0}_setValue_fromArray_setMatrixWorldNeedsUpdate(e,t){this.resolvedProperty.fromArray(e,t),this.targetObject.matrixWorldNeedsUpdate=!0}_getValue_unbound(e,t){this.bind(),this.getValue(e,t)}_setValue_unbound(e,t){this.bind(),this.setValue(e,t)}bind(){let e=this.node,t=this.parsedPath,n=t.objectName,i=t.propertyName,r=t.propertyIndex;if(e||(e=s.findNode(this.rootNode,t.nodeName),this.node=e),this.getValue=this._getValue_unavailable,this.setValue=this._setValue_unavailable,!e){Ce("PropertyBinding: No target node found for track: "+this.path+".");return}if(n){let c=t.objectIndex;switch(n){case"materials":if(!e.material){Le("PropertyBinding: Can not bind to material as node does not have a material.",this);return}if(!e.material.materials){Le("PropertyBinding: Can not bind to material.materials as node.material does not have a materials array.",this);return}e=e.material.materials;break;case"bones":if(!e.skeleton){Le("PropertyBinding: Can not bind to bones as node does not have a skeleton.",this);return}e=e.skeleton.bones;for(let h=0;h<e.length;h++)if(e[h].name===c){c=h;break}break;case"map":if("map"in e){e=e.map;break}if(!e.material){Le("PropertyBinding: Can not bind to material as node does not have a material.",this);return}if(!e.material.map){Le("PropertyBinding: Can not bind to material.map as node.material does not have a map.",this);return}e=e.material.map;break;default:if(e[n]===void 0){Le("PropertyBinding: Can not bind to objectName of node undefined.",this);return}e=e[n]}if(c!==void 0){if(e[c]===void 0){Le("PropertyBinding: Trying to bind to objectIndex of objectName, but is undefined.",this,e);return}e=e[c]}}let o=e[i];if(o===void 0){let c=t.nodeName;Le("PropertyBinding: Trying to update property for track: "+c+"."+i+" but it wasn't found.",e);return}let a=this.Versioning.None;this.targetObject=e,e.isMaterial===!0?a=this.Versioning.NeedsUpdate:e.isObject3D===!0&&(a=this.Versioning.MatrixWorldNeedsUpdate);let l=this.BindingType.Direct;if(r!==void 0){if(i==="morphTargetInfluences"){if(!e.geometry){Le("PropertyBinding: Can not bind to morphTargetInfluences because node does not have a geometry.",this);return}if(!e.geometry.morphAttributes){Le("PropertyBinding: Can not bind to morphTargetInfluences because node does not have a geometry.morphAttributes.",this);return}e.morphTargetDictionary[r]!==void 0&&(r=e.morphTargetDictionary[r])}l=this.BindingType.ArrayElement,this.resolvedProperty=o,this.propertyIndex=r}else o.fromArray!==void 0&&o.toArray!==void 0?(l=this.BindingType.HasFromToArray,this.resolvedProperty=o):Array.isArray(o)?(l=this.BindingType.EntireArray,this.resolvedProperty=o):this.propertyName=i;this.getValue=this.GetterByBindingType[l],this.setValue=this.SetterByBindingTypeAndVersioning[l][a]}unbind(){this.node=null,this.getValue=this._getValue_unbound,this.setValue=this._setValue_unbound}};st.Composite=rc;st.prototype.BindingType={Direct:0,EntireArray:1,ArrayElement:2,HasFromToArray:3};st.prototype.Versioning={None:0,NeedsUpdate:1,MatrixWorldNeedsUpdate:2};st.prototype.GetterByBindingType=[st.prototype._getValue_direct,st.prototype._getValue_array,st.prototype._getValue_arrayElement,st.prototype._getValue_toArray];st.prototype.SetterByBindingTypeAndVersioning=[[st.prototype._setValue_direct,st.prototype._setValue_direct_setNeedsUpdate,st.prototype._setValue_direct_setMatrixWorldNeedsUpdate],[st.prototype._setValue_array,st.prototype._setValue_array_setNeedsUpdate,st.prototype._setValue_array_setMatrixWorldNeedsUpdate],[st.prototype._setValue_arrayElement,st.prototype._setValue_arrayElement_setNeedsUpdate,st.prototype._setValue_arrayElement_setMatrixWorldNeedsUpdate],[st.prototype._setValue_fromArray,st.prototype._setValue_fromArray_setNeedsUpdate,st.prototype._setValue_fromArray_setMatrixWorldNeedsUpdate]];var G_=new Float32Array(1);var oc=class{static{this.prototype.isMatrix2=!0}constructor(e,t,n,i){this.elements=[1,0,0,1],e!==void 0&&this.set(e,t,n,i)}identity(){return this.set(1,0,0,1),this}fromArray(e,t=0){for(let n=0;n<4;n++)this.elements[n]=e[n+t];return this}set(e,t,n,i){let r=this.elements;return r[0]=e,r[2]=t,r[1]=n,r[3]=i,this}};function Oc(s,e,t,n){let i=Dp(n);switch(t){case Ec:return s*e;case Tc:return s*e/i.components*i.byteLength;case ea:return s*e/i.components*i.byteLength;case ci:return s*e*2/i.components*i.byteLength;case ta:return s*e*2/i.components*i.byteLength;case Ac:return s*e*3/i.components*i.byteLength;case mn:return s*e*4/i.components*i.byteLength;case na:return s*e*4/i.components*i.byteLength;case Qs:case er:return Math.floor((s+3)/4)*Math.floor((e+3)/4)*8;case tr:case nr:return Math.floor((s+3)/4)*Math.floor((e+3)/4)*16;case sa:case oa:return Math.max(s,16)*Math.max(e,8)/4;case ia:case ra:return Math.max(s,8)*Math.max(e,8)/2;case aa:case la:case ha:case ua:return Math.floor((s+3)/4)*Math.floor((e+3)/4)*8;case ca:case ir:case da:return Math.floor((s+3)/4)*Math.floor((e+3)/4)*16;case fa:return Math.floor((s+3)/4)*Math.floor((e+3)/4)*16;case pa:return Math.floor((s+4)/5)*Math.floor((e+3)/4)*16;case ma:return Math.floor((s+4)/5)*Math.floor((e+4)/5)*16;case ga:return Math.floor((s+5)/6)*Math.floor((e+4)/5)*16;case ya:return Math.floor((s+5)/6)*Math.floor((e+5)/6)*16;case xa:return Math.floor((s+7)/8)*Math.floor((e+4)/5)*16;case va:return Math.floor((s+7)/8)*Math.floor((e+5)/6)*16;case _a:return Math.floor((s+7)/8)*Math.floor((e+7)/8)*16;case ba:return Math.floor((s+9)/10)*Math.floor((e+4)/5)*16;case Ma:return Math.floor((s+9)/10)*Math.floor((e+5)/6)*16;case Sa:return Math.floor((s+9)/10)*Math.floor((e+7)/8)*16;case wa:return Math.floor((s+9)/10)*Math.floor((e+9)/10)*16;case Ea:return Math.floor((s+11)/12)*Math.floor((e+9)/10)*16;case Aa:return Math.floor((s+11)/12)*Math.floor((e+11)/12)*16;case Ta:case Ra:case Ca:return Math.ceil(s/4)*Math.ceil(e/4)*16;case Pa:case Ia:return Math.ceil(s/4)*Math.ceil(e/4)*8;case sr:case La:return Math.ceil(s/4)*Math.ceil(e/4)*16}throw new Error(`Unable to determine texture byte length for ${t} format.`)}function Dp(s){switch(s){case Ht:case bc:return{byteLength:1,components:1};case as:case Mc:case pn:return{byteLength:2,components:1};case jo:case Qo:return{byteLength:2,components:4};case dn:case Ko:case fn:return{byteLength:4,components:1};case Sc:case wc:return{byteLength:4,components:3}}throw new Error(`THREE.TextureUtils: Unknown texture type ${s}.`)}typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("register",{detail:{revision:"187"}}));typeof window<"u"&&(window.__THREE__?Ce("WARNING: Multiple instances of Three.js being imported."):window.__THREE__="187");function _d(){let s=null,e=!1,t=null,n=null;function i(r,o){n=s.requestAnimationFrame(i),t(r,o)}return{start:function(){e!==!0&&t!==null&&s!==null&&(n=s.requestAnimationFrame(i),e=!0)},stop:function(){s!==null&&s.cancelAnimationFrame(n),e=!1},setAnimationLoop:function(r){t=r},setContext:function(r){s=r}}}function Up(s){let e=new WeakMap;function t(a,l){let c=a.array,h=a.usage,u=c.byteLength,f=s.createBuffer();s.bindBuffer(l,f),s.bufferData(l,c,h),a.onUploadCallback();let d;if(c instanceof Float32Array)d=s.FLOAT;else if(typeof Float16Array<"u"&&c instanceof Float16Array)d=s.HALF_FLOAT;else if(c instanceof Uint16Array)a.isFloat16BufferAttribute?d=s.HALF_FLOAT:d=s.UNSIGNED_SHORT;else if(c instanceof Int16Array)d=s.SHORT;else if(c instanceof Uint32Array)d=s.UNSIGNED_INT;else if(c instanceof Int32Array)d=s.INT;else if(c instanceof Int8Array)d=s.BYTE;else if(c instanceof Uint8Array)d=s.UNSIGNED_BYTE;else if(c instanceof Uint8ClampedArray)d=s.UNSIGNED_BYTE;else throw new Error("THREE.WebGLAttributes: Unsupported buffer data format: "+c);return{buffer:f,type:d,bytesPerElement:c.BYTES_PER_ELEMENT,version:a.version,size:u}}function n(a,l,c){let h=l.array,u=l.updateRanges;if(s.bindBuffer(c,a),u.length===0)s.bufferSubData(c,0,h);else{u.sort((d,g)=>d.start-g.start);let f=0;for(let d=1;d<u.length;d++){let g=u[f],x=u[d];x.start<=g.start+g.count+1?g.count=Math.max(g.count,x.start+x.count-g.start):(++f,u[f]=x)}u.length=f+1;for(let d=0,g=u.length;d<g;d++){let x=u[d];s.bufferSubData(c,x.start*h.BYTES_PER_ELEMENT,h,x.start,x.count)}l.clearUpdateRanges()}l.onUploadCallback()}function i(a){return a.isInterleavedBufferAttribute&&(a=a.data),e.get(a)}function r(a){a.isInterleavedBufferAttribute&&(a=a.data);let l=e.get(a);l&&(s.deleteBuffer(l.buffer),e.delete(a))}function o(a,l){if(a.isInterleavedBufferAttribute&&(a=a.data),a.isGLBufferAttribute){let h=e.get(a);(!h||h.version<a.version)&&e.set(a,{buffer:a.buffer,type:a.type,bytesPerElement:a.elementSize,version:a.version});return}let c=e.get(a);if(c===void 0)e.set(a,t(a,l));else if(c.version<a.version){if(c.size!==a.array.byteLength)throw new Error("THREE.WebGLAttributes: The size of the buffer attribute's array buffer does not match the original size. Resizing buffer attributes is not supported.");n(c.buffer,a,l),c.version=a.version}}return{get:i,remove:r,update:o}}var Op=`#ifdef USE_ALPHAHASH
if(diffuseColor.a<getAlphaHashThreshold(vPosition))discard;
#endif`,Bp=`#ifdef USE_ALPHAHASH
const float ALPHA_HASH_SCALE=0.05;
float hash2D(vec2 value){
return fract(1.0e4*sin(17.0*value.x + 0.1*value.y)*(0.1 + abs(sin(13.0*value.y + value.x))));
}
float hash3D(vec3 value){
return hash2D(vec2(hash2D(value.xy),value.z));
}
float getAlphaHashThreshold(vec3 position){
float maxDeriv=max(
length(dFdx(position.xyz)),
length(dFdy(position.xyz))
);
float pixScale=1.0 /(ALPHA_HASH_SCALE*maxDeriv);
vec2 pixScales=vec2(
exp2(floor(log2(pixScale))),
exp2(ceil(log2(pixScale)))
);
vec2 alpha=vec2(
hash3D(floor(pixScales.x*position.xyz)),
hash3D(floor(pixScales.y*position.xyz))
);
float lerpFactor=fract(log2(pixScale));
float x=(1.0 - lerpFactor)*alpha.x + lerpFactor*alpha.y;
float a=min(lerpFactor,1.0 - lerpFactor);
vec3 cases=vec3(
x*x /(2.0*a*(1.0 - a)),
(x - 0.5*a)/(1.0 - a),
1.0 -((1.0 - x)*(1.0 - x)/(2.0*a*(1.0 - a)))
);
float threshold=(x<(1.0 - a))
?((x<a)?cases.x:cases.y)
:cases.z;
return clamp(threshold,1.0e-6,1.0);
}
#endif`,kp=`#ifdef USE_ALPHAMAP
diffuseColor.a*=texture2D(alphaMap,vAlphaMapUv).g;
#endif`,zp=`#ifdef USE_ALPHAMAP
uniform sampler2D alphaMap;
#endif`,Vp=`#ifdef USE_ALPHATEST
#ifdef ALPHA_TO_COVERAGE
diffuseColor.a=smoothstep(alphaTest,alphaTest + fwidth(diffuseColor.a),diffuseColor.a);
if(diffuseColor.a==0.0)discard;
#else
if(diffuseColor.a<alphaTest)discard;
#endif
#endif`,Gp=`#ifdef USE_ALPHATEST
uniform float alphaTest;
#endif`,Hp=`#ifdef USE_AOMAP
float ambientOcclusion=(texture2D(aoMap,vAoMapUv).r - 1.0)*aoMapIntensity + 1.0;
reflectedLight.indirectDiffuse*=ambientOcclusion;
#if defined( USE_CLEARCOAT )
clearcoatSpecularIndirect*=ambientOcclusion;
#endif
#if defined( USE_SHEEN )
sheenSpecularIndirect*=ambientOcclusion;
#endif
#if defined( USE_ENVMAP ) && defined( STANDARD )
float dotNV=saturate(dot(geometryNormal,geometryViewDir));
reflectedLight.indirectSpecular*=computeSpecularOcclusion(dotNV,ambientOcclusion,material.roughness);
#endif
#endif`,Wp=`#ifdef USE_AOMAP
uniform sampler2D aoMap;
uniform float aoMapIntensity;
#endif`,Xp=`#ifdef USE_BATCHING
#if ! defined( GL_ANGLE_multi_draw )
#define gl_DrawID _gl_DrawID
uniform int _gl_DrawID;
#endif
uniform highp sampler2D batchingTexture;
uniform highp usampler2D batchingIdTexture;
mat4 getBatchingMatrix(const in float i){
int size=textureSize(batchingTexture,0).x;
int j=int(i)*4;
int x=j % size;
int y=j / size;
vec4 v1=texelFetch(batchingTexture,ivec2(x,y),0);
vec4 v2=texelFetch(batchingTexture,ivec2(x + 1,y),0);
vec4 v3=texelFetch(batchingTexture,ivec2(x + 2,y),0);
vec4 v4=texelFetch(batchingTexture,ivec2(x + 3,y),0);
return mat4(v1,v2,v3,v4);
}
float getIndirectIndex(const in int i){
int size=textureSize(batchingIdTexture,0).x;
int x=i % size;
int y=i / size;
return float(texelFetch(batchingIdTexture,ivec2(x,y),0).r);
}
#endif
#ifdef USE_BATCHING_COLOR
uniform sampler2D batchingColorTexture;
vec4 getBatchingColor(const in float i){
int size=textureSize(batchingColorTexture,0).x;
int j=int(i);
int x=j % size;
int y=j / size;
return texelFetch(batchingColorTexture,ivec2(x,y),0);
}
#endif`,qp=`#ifdef USE_BATCHING
mat4 batchingMatrix=getBatchingMatrix(getIndirectIndex(gl_DrawID));
#endif`,Yp=`vec3 transformed=vec3(position);
#ifdef USE_ALPHAHASH
vPosition=vec3(position);
#endif`,$p=`vec3 objectNormal=vec3(normal);
#ifdef USE_TANGENT
vec3 objectTangent=vec3(tangent.xyz);
#endif`,Zp=`float G_BlinnPhong_Implicit(){
return 0.25;
}
float D_BlinnPhong(const in float shininess,const in float dotNH){
return RECIPROCAL_PI*(shininess*0.5 + 1.0)*pow(dotNH,shininess);
}
vec3 BRDF_BlinnPhong(const in vec3 lightDir,const in vec3 viewDir,const in vec3 normal,const in vec3 specularColor,const in float shininess){
vec3 halfDir=normalize(lightDir + viewDir);
float dotNH=saturate(dot(normal,halfDir));
float dotVH=saturate(dot(viewDir,halfDir));
vec3 F=F_Schlick(specularColor,1.0,dotVH);
float G=G_BlinnPhong_Implicit();
float D=D_BlinnPhong(shininess,dotNH);
return F*(G*D);
}`,Jp=`#ifdef USE_IRIDESCENCE
const mat3 XYZ_TO_REC709=mat3(
3.2404542,-0.9692660,0.0556434,
-1.5371385,1.8760108,-0.2040259,
-0.4985314,0.0415560,1.0572252
);
vec3 Fresnel0ToIor(vec3 fresnel0){
vec3 sqrtF0=sqrt(fresnel0);
return(vec3(1.0)+ sqrtF0)/(vec3(1.0)- sqrtF0);
}
vec3 IorToFresnel0(vec3 transmittedIor,float incidentIor){
return pow2((transmittedIor - vec3(incidentIor))/(transmittedIor + vec3(incidentIor)));
}
float IorToFresnel0(float transmittedIor,float incidentIor){
return pow2((transmittedIor - incidentIor)/(transmittedIor + incidentIor));
}
vec3 evalSensitivity(float OPD,vec3 shift){
float phase=2.0*PI*OPD*1.0e-9;
vec3 val=vec3(5.4856e-13,4.4201e-13,5.2481e-13);
vec3 pos=vec3(1.6810e+06,1.7953e+06,2.2084e+06);
vec3 var=vec3(4.3278e+09,9.3046e+09,6.6121e+09);
vec3 xyz=val*sqrt(2.0*PI*var)*cos(pos*phase + shift)*exp(- pow2(phase)*var);
xyz.x +=9.7470e-14*sqrt(2.0*PI*4.5282e+09)*cos(2.2399e+06*phase + shift[ 0 ])*exp(- 4.5282e+09*pow2(phase));
xyz /=1.0685e-7;
vec3 rgb=XYZ_TO_REC709*xyz;
return rgb;
}
vec3 evalIridescence(float outsideIOR,float eta2,float cosTheta1,float thinFilmThickness,vec3 baseF0){
vec3 I;
float iridescenceIOR=mix(outsideIOR,eta2,smoothstep(0.0,0.03,thinFilmThickness));
float sinTheta2Sq=pow2(outsideIOR / iridescenceIOR)*(1.0 - pow2(cosTheta1));
float cosTheta2Sq=1.0 - sinTheta2Sq;
if(cosTheta2Sq<0.0){
return vec3(1.0);
}
float cosTheta2=sqrt(cosTheta2Sq);
float R0=IorToFresnel0(iridescenceIOR,outsideIOR);
float R12=F_Schlick(R0,1.0,cosTheta1);
float T121=1.0 - R12;
float phi12=0.0;
if(iridescenceIOR<outsideIOR)phi12=PI;
float phi21=PI - phi12;
vec3 baseIOR=Fresnel0ToIor(clamp(baseF0,0.0,0.9999));vec3 R1=IorToFresnel0(baseIOR,iridescenceIOR);
vec3 R23=F_Schlick(R1,1.0,cosTheta2);
vec3 phi23=vec3(0.0);
if(baseIOR[ 0 ]<iridescenceIOR)phi23[ 0 ]=PI;
if(baseIOR[ 1 ]<iridescenceIOR)phi23[ 1 ]=PI;
if(baseIOR[ 2 ]<iridescenceIOR)phi23[ 2 ]=PI;
float OPD=2.0*iridescenceIOR*thinFilmThickness*cosTheta2;
vec3 phi=vec3(phi21)+ phi23;
vec3 R123=clamp(R12*R23,1e-5,0.9999);
vec3 r123=sqrt(R123);
vec3 Rs=pow2(T121)*R23 /(vec3(1.0)- R123);
vec3 C0=R12 + Rs;
I=C0;
vec3 Cm=Rs - T121;
for(int m=1;m<=2;++ m){
Cm*=r123;
vec3 Sm=2.0*evalSensitivity(float(m)*OPD,float(m)*phi);
I +=Cm*Sm;
}
return max(I,vec3(0.0));
}
#endif`,Kp=`#ifdef USE_BUMPMAP
uniform sampler2D bumpMap;
uniform float bumpScale;
vec2 dHdxy_fwd(){
vec2 dSTdx=dFdx(vBumpMapUv);
vec2 dSTdy=dFdy(vBumpMapUv);
float Hll=bumpScale*texture2D(bumpMap,vBumpMapUv).x;
float dBx=bumpScale*texture2D(bumpMap,vBumpMapUv + dSTdx).x - Hll;
float dBy=bumpScale*texture2D(bumpMap,vBumpMapUv + dSTdy).x - Hll;
return vec2(dBx,dBy);
}
vec3 perturbNormalArb(vec3 surf_pos,vec3 surf_norm,vec2 dHdxy,float faceDirection){
vec3 vSigmaX=normalize(dFdx(surf_pos.xyz));
vec3 vSigmaY=normalize(dFdy(surf_pos.xyz));
vec3 vN=surf_norm;
vec3 R1=cross(vSigmaY,vN);
vec3 R2=cross(vN,vSigmaX);
float fDet=dot(vSigmaX,R1)*faceDirection;
vec3 vGrad=sign(fDet)*(dHdxy.x*R1 + dHdxy.y*R2);
return normalize(abs(fDet)*surf_norm - vGrad);
}
#endif`,jp=`#if NUM_CLIPPING_PLANES > 0
vec4 plane;
#ifdef ALPHA_TO_COVERAGE
float distanceToPlane,distanceGradient;
float clipOpacity=1.0;
#pragma unroll_loop_start
for(int i=0;i<UNION_CLIPPING_PLANES;i ++){
plane=clippingPlanes[ i ];
distanceToPlane=- dot(vClipPosition,plane.xyz)+ plane.w;
distanceGradient=fwidth(distanceToPlane)/ 2.0;
clipOpacity*=smoothstep(- distanceGradient,distanceGradient,distanceToPlane);
if(clipOpacity==0.0)discard;
}
#pragma unroll_loop_end
#if UNION_CLIPPING_PLANES < NUM_CLIPPING_PLANES
float unionClipOpacity=1.0;
#pragma unroll_loop_start
for(int i=UNION_CLIPPING_PLANES;i<NUM_CLIPPING_PLANES;i ++){
plane=clippingPlanes[ i ];
distanceToPlane=- dot(vClipPosition,plane.xyz)+ plane.w;
distanceGradient=fwidth(distanceToPlane)/ 2.0;
unionClipOpacity*=1.0 - smoothstep(- distanceGradient,distanceGradient,distanceToPlane);
}
#pragma unroll_loop_end
clipOpacity*=1.0 - unionClipOpacity;
#endif
diffuseColor.a*=clipOpacity;
if(diffuseColor.a==0.0)discard;
#else
#pragma unroll_loop_start
for(int i=0;i<UNION_CLIPPING_PLANES;i ++){
plane=clippingPlanes[ i ];
if(dot(vClipPosition,plane.xyz)>plane.w)discard;
}
#pragma unroll_loop_end
#if UNION_CLIPPING_PLANES < NUM_CLIPPING_PLANES
bool clipped=true;
#pragma unroll_loop_start
for(int i=UNION_CLIPPING_PLANES;i<NUM_CLIPPING_PLANES;i ++){
plane=clippingPlanes[ i ];
clipped=(dot(vClipPosition,plane.xyz)>plane.w)&&clipped;
}
#pragma unroll_loop_end
if(clipped)discard;
#endif
#endif
#endif`,Qp=`#if NUM_CLIPPING_PLANES > 0
varying vec3 vClipPosition;
uniform vec4 clippingPlanes[ NUM_CLIPPING_PLANES ];
#endif`,em=`#if NUM_CLIPPING_PLANES > 0
varying vec3 vClipPosition;
#endif`,tm=`#if NUM_CLIPPING_PLANES > 0
vClipPosition=- mvPosition.xyz;
#endif`,nm=`#if defined( USE_COLOR ) || defined( USE_COLOR_ALPHA )
diffuseColor*=vColor;
#endif`,im=`#if defined( USE_COLOR ) || defined( USE_COLOR_ALPHA )
varying vec4 vColor;
#endif`,sm=`#if defined( USE_COLOR ) || defined( USE_COLOR_ALPHA ) || defined( USE_INSTANCING_COLOR ) || defined( USE_BATCHING_COLOR )
varying vec4 vColor;
#endif`,rm=`#if defined( USE_COLOR ) || defined( USE_COLOR_ALPHA ) || defined( USE_INSTANCING_COLOR ) || defined( USE_BATCHING_COLOR )
vColor=vec4(1.0);
#endif
#ifdef USE_COLOR_ALPHA
vColor*=color;
#elif defined( USE_COLOR )
vColor.rgb*=color;
#endif
#ifdef USE_INSTANCING_COLOR
vColor.rgb*=instanceColor.rgb;
#endif
#ifdef USE_BATCHING_COLOR
vColor*=getBatchingColor(getIndirectIndex(gl_DrawID));
#endif`,om=`#define PI 3.141592653589793
#define PI2 6.283185307179586
#define PI_HALF 1.5707963267948966
#define RECIPROCAL_PI 0.3183098861837907
#define RECIPROCAL_PI2 0.15915494309189535
#define EPSILON 1e-6
#ifndef saturate
#define saturate( a ) clamp( a, 0.0, 1.0 )
#endif
#define whiteComplement( a ) ( 1.0 - saturate( a ) )
float pow2(const in float x){return x*x;}
vec3 pow2(const in vec3 x){return x*x;}
float pow3(const in float x){return x*x*x;}
float pow4(const in float x){float x2=x*x;return x2*x2;}
float max3(const in vec3 v){return max(max(v.x,v.y),v.z);}
float average(const in vec3 v){return dot(v,vec3(0.3333333));}
highp float rand(const in vec2 uv){
const highp float a=12.9898,b=78.233,c=43758.5453;
highp float dt=dot(uv.xy,vec2(a,b)),sn=mod(dt,PI);
return fract(sin(sn)*c);
}
#ifdef HIGH_PRECISION
float precisionSafeLength(vec3 v){return length(v);}
#else
float precisionSafeLength(vec3 v){
float maxComponent=max3(abs(v));
return length(v / maxComponent)*maxComponent;
}
#endif
struct IncidentLight{
vec3 color;
vec3 direction;
bool visible;
};
struct ReflectedLight{
vec3 directDiffuse;
vec3 directSpecular;
vec3 indirectDiffuse;
vec3 indirectSpecular;
};
#ifdef USE_ALPHAHASH
varying vec3 vPosition;
#endif
vec3 transformDirection(in vec3 dir,in mat4 matrix){
return normalize((matrix*vec4(dir,0.0)).xyz);
}
#define inverseTransformDirection transformDirectionByInverseViewMatrix
vec3 transformNormalByInverseViewMatrix(in vec3 normal,in mat4 viewMatrix){
return normalize((vec4(normal,0.0)*viewMatrix).xyz);
}
vec3 transformDirectionByInverseViewMatrix(in vec3 dir,in mat4 viewMatrix){
return normalize((vec4(dir,0.0)*viewMatrix).xyz);
}
bool isPerspectiveMatrix(mat4 m){
return m[ 2 ][ 3 ]==- 1.0;
}
vec2 equirectUv(in vec3 dir){
float u=atan(dir.z,dir.x)*RECIPROCAL_PI2 + 0.5;
float v=asin(clamp(dir.y,- 1.0,1.0))*RECIPROCAL_PI + 0.5;
return vec2(u,v);
}
vec3 BRDF_Lambert(const in vec3 diffuseColor){
return RECIPROCAL_PI*diffuseColor;
}
vec3 F_Schlick(const in vec3 f0,const in float f90,const in float dotVH){
float fresnel=exp2((- 5.55473*dotVH - 6.98316)*dotVH);
return f0*(1.0 - fresnel)+(f90*fresnel);
}
float F_Schlick(const in float f0,const in float f90,const in float dotVH){
float fresnel=exp2((- 5.55473*dotVH - 6.98316)*dotVH);
return f0*(1.0 - fresnel)+(f90*fresnel);
}`,am=`vec3 transformedNormal=objectNormal;
#ifdef USE_TANGENT
vec3 transformedTangent=objectTangent;
#endif
#ifdef USE_BATCHING
mat3 bm=mat3(batchingMatrix);
transformedNormal /=vec3(dot(bm[ 0 ],bm[ 0 ]),dot(bm[ 1 ],bm[ 1 ]),dot(bm[ 2 ],bm[ 2 ]));
transformedNormal=bm*transformedNormal;
#ifdef USE_TANGENT
transformedTangent=bm*transformedTangent;
#endif
#endif
#ifdef USE_INSTANCING
mat3 im=mat3(instanceMatrix);
transformedNormal /=vec3(dot(im[ 0 ],im[ 0 ]),dot(im[ 1 ],im[ 1 ]),dot(im[ 2 ],im[ 2 ]));
transformedNormal=im*transformedNormal;
#ifdef USE_TANGENT
transformedTangent=im*transformedTangent;
#endif
#endif
transformedNormal=normalMatrix*transformedNormal;
#ifdef FLIP_SIDED
transformedNormal=- transformedNormal;
#endif
#ifdef USE_TANGENT
transformedTangent=(modelViewMatrix*vec4(transformedTangent,0.0)).xyz;
#endif`,lm=`#ifdef USE_DISPLACEMENTMAP
uniform sampler2D displacementMap;
uniform float displacementScale;
uniform float displacementBias;
#endif`,cm=`#ifdef USE_DISPLACEMENTMAP
transformed +=normalize(objectNormal)*(texture2D(displacementMap,vDisplacementMapUv).x*displacementScale + displacementBias);
#endif`,hm=`#ifdef USE_EMISSIVEMAP
vec4 emissiveColor=texture2D(emissiveMap,vEmissiveMapUv);
#ifdef DECODE_VIDEO_TEXTURE_EMISSIVE
emissiveColor=sRGBTransferEOTF(emissiveColor);
#endif
totalEmissiveRadiance*=emissiveColor.rgb;
#endif`,um=`#ifdef USE_EMISSIVEMAP
uniform sampler2D emissiveMap;
#endif`,dm="gl_FragColor = linearToOutputTexel( gl_FragColor );",fm=`vec4 LinearTransferOETF(in vec4 value){
return value;
}
vec4 sRGBTransferEOTF(in vec4 value){
return vec4(mix(pow(value.rgb*0.9478672986 + vec3(0.0521327014),vec3(2.4)),value.rgb*0.0773993808,vec3(lessThanEqual(value.rgb,vec3(0.04045)))),value.a);
}
vec4 sRGBTransferOETF(in vec4 value){
return vec4(mix(pow(value.rgb,vec3(0.41666))*1.055 - vec3(0.055),value.rgb*12.92,vec3(lessThanEqual(value.rgb,vec3(0.0031308)))),value.a);
}`,pm=`#ifdef USE_ENVMAP
#ifdef ENV_WORLDPOS
vec3 cameraToFrag;
if(isOrthographic){
cameraToFrag=normalize(vec3(- viewMatrix[ 0 ][ 2 ],- viewMatrix[ 1 ][ 2 ],- viewMatrix[ 2 ][ 2 ]));
}else{
cameraToFrag=normalize(vWorldPosition - cameraPosition);
}
vec3 worldNormal=transformNormalByInverseViewMatrix(normal,viewMatrix);
#ifdef ENVMAP_MODE_REFLECTION
vec3 reflectVec=reflect(cameraToFrag,worldNormal);
#else
vec3 reflectVec=refract(cameraToFrag,worldNormal,refractionRatio);
#endif
#else
vec3 reflectVec=vReflect;
#endif
#ifdef ENVMAP_TYPE_CUBE
vec4 envColor=textureCube(envMap,envMapRotation*reflectVec);
#ifdef ENVMAP_BLENDING_MULTIPLY
outgoingLight=mix(outgoingLight,outgoingLight*envColor.xyz,specularStrength*reflectivity);
#elif defined( ENVMAP_BLENDING_MIX )
outgoingLight=mix(outgoingLight,envColor.xyz,specularStrength*reflectivity);
#elif defined( ENVMAP_BLENDING_ADD )
outgoingLight +=envColor.xyz*specularStrength*reflectivity;
#endif
#endif
#endif`,mm=`#ifdef USE_ENVMAP
uniform float envMapIntensity;
uniform mat3 envMapRotation;
uniform samplerCube envMap;
#ifdef ENVMAP_TYPE_PMREM
float roughnessToMip(const in float roughness){
float r=clamp(roughness,0.0,1.0);
return ENVMAP_MAX_LOD*r*(2.0 - r);
}
#endif
#endif`,gm=`#ifdef USE_ENVMAP
uniform float reflectivity;
#if defined( USE_BUMPMAP ) || defined( USE_NORMALMAP ) || defined( PHONG ) || defined( LAMBERT )
#define ENV_WORLDPOS
#endif
#ifdef ENV_WORLDPOS
varying vec3 vWorldPosition;
uniform float refractionRatio;
#else
varying vec3 vReflect;
#endif
#endif`,ym=`#ifdef USE_ENVMAP
#if defined( USE_BUMPMAP ) || defined( USE_NORMALMAP ) || defined( PHONG ) || defined( LAMBERT )
#define ENV_WORLDPOS
#endif
#ifdef ENV_WORLDPOS
varying vec3 vWorldPosition;
#else
varying vec3 vReflect;
uniform float refractionRatio;
#endif
#endif`,xm=`#ifdef USE_ENVMAP
#ifdef ENV_WORLDPOS
vWorldPosition=worldPosition.xyz;
#else
vec3 cameraToVertex;
if(isOrthographic){
cameraToVertex=normalize(vec3(- viewMatrix[ 0 ][ 2 ],- viewMatrix[ 1 ][ 2 ],- viewMatrix[ 2 ][ 2 ]));
}else{
cameraToVertex=normalize(worldPosition.xyz - cameraPosition);
}
vec3 worldNormal=transformNormalByInverseViewMatrix(transformedNormal,viewMatrix);
#ifdef ENVMAP_MODE_REFLECTION
vReflect=reflect(cameraToVertex,worldNormal);
#else
vReflect=refract(cameraToVertex,worldNormal,refractionRatio);
#endif
#endif
#endif`,vm=`#ifdef USE_FOG
vFogDepth=- mvPosition.z;
#endif`,_m=`#ifdef USE_FOG
varying float vFogDepth;
#endif`,bm=`#ifdef USE_FOG
#ifdef FOG_EXP2
float fogFactor=1.0 - exp(- fogDensity*fogDensity*vFogDepth*vFogDepth);
#else
float fogFactor=smoothstep(fogNear,fogFar,vFogDepth);
#endif
gl_FragColor.rgb=mix(gl_FragColor.rgb,fogColor,fogFactor);
#endif`,Mm=`#ifdef USE_FOG
uniform vec3 fogColor;
varying float vFogDepth;
#ifdef FOG_EXP2
uniform float fogDensity;
#else
uniform float fogNear;
uniform float fogFar;
#endif
#endif`,Sm=`#ifdef USE_GRADIENTMAP
uniform sampler2D gradientMap;
#endif
vec3 getGradientIrradiance(vec3 normal,vec3 lightDirection){
float dotNL=dot(normal,lightDirection);
vec2 coord=vec2(dotNL*0.5 + 0.5,0.0);
#ifdef USE_GRADIENTMAP
return vec3(texture2D(gradientMap,coord).r);
#else
vec2 fw=fwidth(coord)*0.5;
return mix(vec3(0.7),vec3(1.0),smoothstep(0.7 - fw.x,0.7 + fw.x,coord.x));
#endif
}`,wm=`#ifdef USE_LIGHTMAP
uniform sampler2D lightMap;
uniform float lightMapIntensity;
#endif`,Em=`LambertMaterial material;
material.diffuseColor=diffuseColor.rgb;
material.specularStrength=specularStrength;`,Am=`varying vec3 vViewPosition;
struct LambertMaterial{
vec3 diffuseColor;
float specularStrength;
};
void RE_Direct_Lambert(const in IncidentLight directLight,const in vec3 geometryPosition,const in vec3 geometryNormal,const in vec3 geometryViewDir,const in vec3 geometryClearcoatNormal,const in LambertMaterial material,inout ReflectedLight reflectedLight){
float dotNL=saturate(dot(geometryNormal,directLight.direction));
vec3 irradiance=dotNL*directLight.color;
reflectedLight.directDiffuse +=irradiance*BRDF_Lambert(material.diffuseColor);
}
void RE_IndirectDiffuse_Lambert(const in vec3 irradiance,const in vec3 geometryPosition,const in vec3 geometryNormal,const in vec3 geometryViewDir,const in vec3 geometryClearcoatNormal,const in LambertMaterial material,inout ReflectedLight reflectedLight){
reflectedLight.indirectDiffuse +=irradiance*BRDF_Lambert(material.diffuseColor);
}
#define RE_Direct    RE_Direct_Lambert
#define RE_IndirectDiffuse  RE_IndirectDiffuse_Lambert`,Tm=`uniform bool receiveShadow;
uniform vec3 ambientLightColor;
#if defined( USE_LIGHT_PROBES )
uniform vec3 lightProbe[ 9 ];
#endif
vec3 shGetIrradianceAt(in vec3 normal,in vec3 shCoefficients[ 9 ]){
float x=normal.x,y=normal.y,z=normal.z;
vec3 result=shCoefficients[ 0 ]*0.886227;
result +=shCoefficients[ 1 ]*2.0*0.511664*y;
result +=shCoefficients[ 2 ]*2.0*0.511664*z;
result +=shCoefficients[ 3 ]*2.0*0.511664*x;
result +=shCoefficients[ 4 ]*2.0*0.429043*x*y;
result +=shCoefficients[ 5 ]*2.0*0.429043*y*z;
result +=shCoefficients[ 6 ]*(0.743125*z*z - 0.247708);
result +=shCoefficients[ 7 ]*2.0*0.429043*x*z;
result +=shCoefficients[ 8 ]*0.429043*(x*x - y*y);
return result;
}
vec3 getLightProbeIrradiance(const in vec3 lightProbe[ 9 ],const in vec3 normal){
vec3 worldNormal=transformNormalByInverseViewMatrix(normal,viewMatrix);
vec3 irradiance=shGetIrradianceAt(worldNormal,lightProbe);
return irradiance;
}
vec3 getAmbientLightIrradiance(const in vec3 ambientLightColor){
vec3 irradiance=ambientLightColor;
return irradiance;
}
float getDistanceAttenuation(const in float lightDistance,const in float cutoffDistance,const in float decayExponent){
float distanceFalloff=1.0 / max(pow(lightDistance,decayExponent),0.01);
if(cutoffDistance>0.0){
distanceFalloff*=pow2(saturate(1.0 - pow4(lightDistance / cutoffDistance)));
}
return distanceFalloff;
}
float getSpotAttenuation(const in float coneCosine,const in float penumbraCosine,const in float angleCosine){
return smoothstep(coneCosine,penumbraCosine,angleCosine);
}
#if NUM_SUN_LIGHTS > 0
struct SunLight{
vec3 direction;
vec3 color;
};
uniform SunLight sunLights[ NUM_SUN_LIGHTS ];
void getSunLightInfo(const in SunLight sunLight,out IncidentLight light){
light.color=sunLight.color;
light.direction=sunLight.direction;
light.visible=true;
}
#endif
#if NUM_DIR_LIGHTS > 0
struct DirectionalLight{
vec3 direction;
vec3 color;
};
uniform DirectionalLight directionalLights[ NUM_DIR_LIGHTS ];
void getDirectionalLightInfo(const in DirectionalLight directionalLight,out IncidentLight light){
light.color=directionalLight.color;
light.direction=directionalLight.direction;
light.visible=true;
}
#endif
#if NUM_POINT_LIGHTS > 0
struct PointLight{
vec3 position;
vec3 color;
float distance;
float decay;
};
uniform PointLight pointLights[ NUM_POINT_LIGHTS ];
void getPointLightInfo(const in PointLight pointLight,const in vec3 geometryPosition,out IncidentLight light){
vec3 lVector=pointLight.position - geometryPosition;
light.direction=normalize(lVector);
float lightDistance=length(lVector);
light.color=pointLight.color;
light.color*=getDistanceAttenuation(lightDistance,pointLight.distance,pointLight.decay);
light.visible=(light.color !=vec3(0.0));
}
#endif
#if NUM_SPOT_LIGHTS > 0
struct SpotLight{
vec3 position;
vec3 direction;
vec3 color;
float distance;
float decay;
float coneCos;
float penumbraCos;
};
uniform SpotLight spotLights[ NUM_SPOT_LIGHTS ];
void getSpotLightInfo(const in SpotLight spotLight,const in vec3 geometryPosition,out IncidentLight light){
vec3 lVector=spotLight.position - geometryPosition;
light.direction=normalize(lVector);
float angleCos=dot(light.direction,spotLight.direction);
float spotAttenuation=getSpotAttenuation(spotLight.coneCos,spotLight.penumbraCos,angleCos);
if(spotAttenuation>0.0){
float lightDistance=length(lVector);
light.color=spotLight.color*spotAttenuation;
light.color*=getDistanceAttenuation(lightDistance,spotLight.distance,spotLight.decay);
light.visible=(light.color !=vec3(0.0));
}else{
light.color=vec3(0.0);
light.visible=false;
}
}
#endif
#if NUM_RECT_AREA_LIGHTS > 0
struct RectAreaLight{
vec3 color;
vec3 position;
vec3 halfWidth;
vec3 halfHeight;
};
uniform sampler2D ltc_1;uniform sampler2D ltc_2;
uniform RectAreaLight rectAreaLights[ NUM_RECT_AREA_LIGHTS ];
#endif
#if NUM_HEMI_LIGHTS > 0
struct HemisphereLight{
vec3 direction;
vec3 skyColor;
vec3 groundColor;
};
uniform HemisphereLight hemisphereLights[ NUM_HEMI_LIGHTS ];
vec3 getHemisphereLightIrradiance(const in HemisphereLight hemiLight,const in vec3 normal){
float dotNL=dot(normal,hemiLight.direction);
float hemiDiffuseWeight=0.5*dotNL + 0.5;
vec3 irradiance=mix(hemiLight.groundColor,hemiLight.skyColor,hemiDiffuseWeight);
return irradiance;
}
#endif
#include <lightprobes_pars_fragment>`,Rm=`#ifdef USE_ENVMAP
vec3 getIBLIrradiance(const in vec3 normal){
#ifdef ENVMAP_TYPE_PMREM
vec3 worldNormal=transformNormalByInverseViewMatrix(normal,viewMatrix);
vec4 envMapColor=textureLod(envMap,envMapRotation*worldNormal,ENVMAP_MAX_LOD);
return PI*envMapColor.rgb*envMapIntensity;
#else
return vec3(0.0);
#endif
}
vec3 getIBLRadiance(const in vec3 viewDir,const in vec3 normal,const in float roughness){
#ifdef ENVMAP_TYPE_PMREM
vec3 reflectVec=reflect(- viewDir,normal);
reflectVec=normalize(mix(reflectVec,normal,pow4(roughness)));
reflectVec=transformDirectionByInverseViewMatrix(reflectVec,viewMatrix);
vec4 envMapColor=textureLod(envMap,envMapRotation*reflectVec,roughnessToMip(roughness));
return envMapColor.rgb*envMapIntensity;
#else
return vec3(0.0);
#endif
}
#ifdef USE_RETROREFLECTION
vec3 getIBLRetroRadiance(const in vec3 viewDir,const in vec3 normal,const in float roughness){
#ifdef ENVMAP_TYPE_PMREM
vec3 retroVec=normalize(mix(viewDir,normal,pow4(roughness)));
retroVec=transformDirectionByInverseViewMatrix(retroVec,viewMatrix);
vec4 envMapColor=textureLod(envMap,envMapRotation*retroVec,roughnessToMip(roughness));
return envMapColor.rgb*envMapIntensity;
#else
return vec3(0.0);
#endif
}
#endif
#ifdef USE_ANISOTROPY
vec3 getIBLAnisotropyRadiance(const in vec3 viewDir,const in vec3 normal,const in float roughness,const in vec3 bitangent,const in float anisotropy){
#ifdef ENVMAP_TYPE_PMREM
vec3 bentNormal=cross(bitangent,viewDir);
bentNormal=normalize(cross(bentNormal,bitangent));
bentNormal=normalize(mix(bentNormal,normal,pow2(pow2(1.0 - anisotropy*(1.0 - roughness)))));
return getIBLRadiance(viewDir,bentNormal,roughness);
#else
return vec3(0.0);
#endif
}
#ifdef USE_RETROREFLECTION
vec3 getIBLAnisotropyRetroRadiance(const in vec3 viewDir,const in vec3 normal,const in float roughness,const in vec3 bitangent,const in float anisotropy){
#ifdef ENVMAP_TYPE_PMREM
vec3 bentNormal=cross(bitangent,viewDir);
bentNormal=normalize(cross(bentNormal,bitangent));
bentNormal=normalize(mix(bentNormal,normal,pow2(pow2(1.0 - anisotropy*(1.0 - roughness)))));
return getIBLRetroRadiance(viewDir,bentNormal,roughness);
#else
return vec3(0.0);
#endif
}
#endif
#endif
#endif`,Cm=`ToonMaterial material;
material.diffuseColor=diffuseColor.rgb;`,Pm=`varying vec3 vViewPosition;
struct ToonMaterial{
vec3 diffuseColor;
};
void RE_Direct_Toon(const in IncidentLight directLight,const in vec3 geometryPosition,const in vec3 geometryNormal,const in vec3 geometryViewDir,const in vec3 geometryClearcoatNormal,const in ToonMaterial material,inout ReflectedLight reflectedLight){
vec3 irradiance=getGradientIrradiance(geometryNormal,directLight.direction)*directLight.color;
reflectedLight.directDiffuse +=irradiance*BRDF_Lambert(material.diffuseColor);
}
void RE_IndirectDiffuse_Toon(const in vec3 irradiance,const in vec3 geometryPosition,const in vec3 geometryNormal,const in vec3 geometryViewDir,const in vec3 geometryClearcoatNormal,const in ToonMaterial material,inout ReflectedLight reflectedLight){
reflectedLight.indirectDiffuse +=irradiance*BRDF_Lambert(material.diffuseColor);
}
#define RE_Direct    RE_Direct_Toon
#define RE_IndirectDiffuse  RE_IndirectDiffuse_Toon`,Im=`BlinnPhongMaterial material;
material.diffuseColor=diffuseColor.rgb;
material.specularColor=specular;
material.specularShininess=shininess;
material.specularStrength=specularStrength;`,Lm=`varying vec3 vViewPosition;
struct BlinnPhongMaterial{
vec3 diffuseColor;
vec3 specularColor;
float specularShininess;
float specularStrength;
};
void RE_Direct_BlinnPhong(const in IncidentLight directLight,const in vec3 geometryPosition,const in vec3 geometryNormal,const in vec3 geometryViewDir,const in vec3 geometryClearcoatNormal,const in BlinnPhongMaterial material,inout ReflectedLight reflectedLight){
float dotNL=saturate(dot(geometryNormal,directLight.direction));
vec3 irradiance=dotNL*directLight.color;
reflectedLight.directDiffuse +=irradiance*BRDF_Lambert(material.diffuseColor);
reflectedLight.directSpecular +=irradiance*BRDF_BlinnPhong(directLight.direction,geometryViewDir,geometryNormal,material.specularColor,material.specularShininess)*material.specularStrength;
}
void RE_IndirectDiffuse_BlinnPhong(const in vec3 irradiance,const in vec3 geometryPosition,const in vec3 geometryNormal,const in vec3 geometryViewDir,const in vec3 geometryClearcoatNormal,const in BlinnPhongMaterial material,inout ReflectedLight reflectedLight){
reflectedLight.indirectDiffuse +=irradiance*BRDF_Lambert(material.diffuseColor);
}
#define RE_Direct    RE_Direct_BlinnPhong
#define RE_IndirectDiffuse  RE_IndirectDiffuse_BlinnPhong`,Nm=`PhysicalMaterial material;
material.diffuseColor=diffuseColor.rgb;
material.diffuseContribution=diffuseColor.rgb*(1.0 - metalnessFactor);
material.metalness=metalnessFactor;
vec3 dxy=max(abs(dFdx(nonPerturbedNormal)),abs(dFdy(nonPerturbedNormal)));
float geometryRoughness=max(max(dxy.x,dxy.y),dxy.z);
material.roughness=max(roughnessFactor,0.045);
material.roughness +=geometryRoughness;
material.roughness=min(material.roughness,1.0);
#ifdef USE_DIFFUSE_ROUGHNESS
float diffuseRoughnessFactor=diffuseRoughness;
#ifdef USE_DIFFUSE_ROUGHNESSMAP
diffuseRoughnessFactor*=texture2D(diffuseRoughnessMap,vDiffuseRoughnessMapUv).r;
#endif
material.diffuseRoughness=saturate(diffuseRoughnessFactor);
#endif
#ifdef IOR
material.ior=ior;
#ifdef USE_SPECULAR
float specularIntensityFactor=specularIntensity;
vec3 specularColorFactor=specularColor;
#ifdef USE_SPECULAR_COLORMAP
specularColorFactor*=texture2D(specularColorMap,vSpecularColorMapUv).rgb;
#endif
#ifdef USE_SPECULAR_INTENSITYMAP
specularIntensityFactor*=texture2D(specularIntensityMap,vSpecularIntensityMapUv).a;
#endif
material.specularF90=mix(specularIntensityFactor,1.0,metalnessFactor);
#else
float specularIntensityFactor=1.0;
vec3 specularColorFactor=vec3(1.0);
material.specularF90=1.0;
#endif
material.specularColor=min(pow2((material.ior - 1.0)/(material.ior + 1.0))*specularColorFactor,vec3(1.0))*specularIntensityFactor;
material.specularColorBlended=mix(material.specularColor,diffuseColor.rgb,metalnessFactor);
#else
material.specularColor=vec3(0.04);
material.specularColorBlended=mix(material.specularColor,diffuseColor.rgb,metalnessFactor);
material.specularF90=1.0;
#endif
#ifdef USE_CLEARCOAT
material.clearcoat=clearcoat;
material.clearcoatRoughness=clearcoatRoughness;
material.clearcoatF0=vec3(0.04);
material.clearcoatF90=1.0;
#ifdef USE_CLEARCOATMAP
material.clearcoat*=texture2D(clearcoatMap,vClearcoatMapUv).x;
#endif
#ifdef USE_CLEARCOAT_ROUGHNESSMAP
material.clearcoatRoughness*=texture2D(clearcoatRoughnessMap,vClearcoatRoughnessMapUv).y;
#endif
material.clearcoat=saturate(material.clearcoat);material.clearcoatRoughness=max(material.clearcoatRoughness,0.045);
material.clearcoatRoughness +=geometryRoughness;
material.clearcoatRoughness=min(material.clearcoatRoughness,1.0);
#endif
#ifdef USE_DISPERSION
material.dispersion=dispersion;
#endif
#ifdef USE_RETROREFLECTION
material.retroreflectivity=retroreflectivity;
#endif
#ifdef USE_IRIDESCENCE
material.iridescence=iridescence;
material.iridescenceIOR=iridescenceIOR;
#ifdef USE_IRIDESCENCEMAP
material.iridescence*=texture2D(iridescenceMap,vIridescenceMapUv).r;
#endif
#ifdef USE_IRIDESCENCE_THICKNESSMAP
material.iridescenceThickness=(iridescenceThicknessMaximum - iridescenceThicknessMinimum)*texture2D(iridescenceThicknessMap,vIridescenceThicknessMapUv).g + iridescenceThicknessMinimum;
#else
material.iridescenceThickness=iridescenceThicknessMaximum;
#endif
#endif
#ifdef USE_SHEEN
material.sheenColor=sheenColor;
#ifdef USE_SHEEN_COLORMAP
material.sheenColor*=texture2D(sheenColorMap,vSheenColorMapUv).rgb;
#endif
material.sheenRoughness=clamp(sheenRoughness,0.0001,1.0);
#ifdef USE_SHEEN_ROUGHNESSMAP
material.sheenRoughness*=texture2D(sheenRoughnessMap,vSheenRoughnessMapUv).a;
#endif
#endif
#ifdef USE_ANISOTROPY
#ifdef USE_ANISOTROPYMAP
mat2 anisotropyMat=mat2(anisotropyVector.x,anisotropyVector.y,- anisotropyVector.y,anisotropyVector.x);
vec3 anisotropyPolar=texture2D(anisotropyMap,vAnisotropyMapUv).rgb;
vec2 anisotropyV=anisotropyMat*normalize(2.0*anisotropyPolar.rg - vec2(1.0))*anisotropyPolar.b;
#else
vec2 anisotropyV=anisotropyVector;
#endif
material.anisotropy=length(anisotropyV);
if(material.anisotropy==0.0){
anisotropyV=vec2(1.0,0.0);
}else{
anisotropyV /=material.anisotropy;
material.anisotropy=saturate(material.anisotropy);
}
material.alphaT=mix(pow2(material.roughness),1.0,pow2(material.anisotropy));
material.anisotropyT=tbn[ 0 ]*anisotropyV.x + tbn[ 1 ]*anisotropyV.y;
material.anisotropyB=tbn[ 1 ]*anisotropyV.x - tbn[ 0 ]*anisotropyV.y;
#endif`,Dm=`uniform sampler2D dfgLUT;
struct PhysicalMaterial{
vec3 diffuseColor;
vec3 diffuseContribution;
vec3 specularColor;
vec3 specularColorBlended;
float roughness;
float metalness;
float specularF90;
float dispersion;
vec2 dfg;
vec3 multiScatteringCompensation;
#ifdef USE_DIFFUSE_ROUGHNESS
float diffuseRoughness;
#endif
#ifdef USE_RETROREFLECTION
float retroreflectivity;
#endif
#ifdef USE_CLEARCOAT
float clearcoat;
float clearcoatRoughness;
vec3 clearcoatF0;
float clearcoatF90;
#endif
#ifdef USE_IRIDESCENCE
float iridescence;
float iridescenceIOR;
float iridescenceThickness;
vec3 iridescenceFresnel;
vec3 iridescenceF0Dielectric;
vec3 iridescenceF0Metallic;
#endif
#ifdef USE_SHEEN
vec3 sheenColor;
float sheenRoughness;
#endif
#ifdef IOR
float ior;
#endif
#ifdef USE_TRANSMISSION
float transmission;
float transmissionAlpha;
float thickness;
float attenuationDistance;
vec3 attenuationColor;
#endif
#ifdef USE_ANISOTROPY
float anisotropy;
float alphaT;
vec3 anisotropyT;
vec3 anisotropyB;
#endif
};
vec3 clearcoatSpecularDirect=vec3(0.0);
vec3 clearcoatSpecularIndirect=vec3(0.0);
vec3 sheenSpecularDirect=vec3(0.0);
vec3 sheenSpecularIndirect=vec3(0.0);
vec3 Schlick_to_F0(const in vec3 f,const in float f90,const in float dotVH){
float x=clamp(1.0 - dotVH,0.0,1.0);
float x2=x*x;
float x5=clamp(x*x2*x2,0.0,0.9999);
return(f - vec3(f90)*x5)/(1.0 - x5);
}
#ifdef USE_DIFFUSE_ROUGHNESS
const float EON_EPSILON=1e-7;
float FON_DirectionalAlbedo(const in float mu,const in float roughness,const in float A){
float muComp=1.0 - mu;
float gOverPi=muComp*(0.0571085289 + muComp*(0.491881867 + muComp*(- 0.332181442 + muComp*0.0714429953)));
return A*(1.0 + roughness*gOverPi);
}
vec3 BRDF_EON(const in vec3 lightDir,const in vec3 viewDir,const in vec3 normal,const in vec3 diffuseColor,const in float roughness){
vec3 rho=saturate(diffuseColor);
if(roughness<=EON_EPSILON)return BRDF_Lambert(rho);
float dotNL=saturate(dot(normal,lightDir));
float dotNV=saturate(dot(normal,viewDir));
float s=dot(lightDir,viewDir)- dotNL*dotNV;
float sOverT=(s>0.0)?s / max(max(dotNL,dotNV),EON_EPSILON):s;
float A=1.0 /(1.0 +(0.5 - 2.0 /(3.0*PI))*roughness);
vec3 singleScatter=rho*RECIPROCAL_PI*A*(1.0 + roughness*sOverT);
float averageAlbedo=A*(1.0 +(2.0 / 3.0 - 28.0 /(15.0*PI))*roughness);
float albedoV=FON_DirectionalAlbedo(dotNV,roughness,A);
float albedoL=FON_DirectionalAlbedo(dotNL,roughness,A);
vec3 rhoMultiScatter=rho*rho*averageAlbedo / max(vec3(EON_EPSILON),vec3(1.0)- rho*(1.0 - averageAlbedo));
vec3 multiScatter=rhoMultiScatter*RECIPROCAL_PI
*max(EON_EPSILON,1.0 - albedoV)
*max(EON_EPSILON,1.0 - albedoL)
/ max(EON_EPSILON,1.0 - averageAlbedo);
return singleScatter + multiScatter;
}
vec3 EON_DirectionalAlbedo(const in vec3 diffuseColor,const in float roughness,const in float dotNV){
vec3 rho=saturate(diffuseColor);
if(roughness<=EON_EPSILON)return rho;
float A=1.0 /(1.0 +(0.5 - 2.0 /(3.0*PI))*roughness);
float directionalAlbedo=FON_DirectionalAlbedo(dotNV,roughness,A);
float averageAlbedo=A*(1.0 +(2.0 / 3.0 - 28.0 /(15.0*PI))*roughness);
vec3 rhoMultiScatter=rho*rho*averageAlbedo / max(vec3(EON_EPSILON),vec3(1.0)- rho*(1.0 - averageAlbedo));
return rho*directionalAlbedo + rhoMultiScatter*(1.0 - directionalAlbedo);
}
#endif
float V_GGX_SmithCorrelated(const in float alpha,const in float dotNL,const in float dotNV){
float a2=pow2(alpha);
float gv=dotNL*sqrt(a2 +(1.0 - a2)*pow2(dotNV));
float gl=dotNV*sqrt(a2 +(1.0 - a2)*pow2(dotNL));
return 0.5 / max(gv + gl,EPSILON);
}
float D_GGX(const in float alpha,const in float dotNH){
float a2=pow2(alpha);
float denom=pow2(dotNH)*(a2 - 1.0)+ 1.0;
return RECIPROCAL_PI*a2 / pow2(denom);
}
#ifdef USE_ANISOTROPY
float V_GGX_SmithCorrelated_Anisotropic(const in float alphaT,const in float alphaB,const in float dotTV,const in float dotBV,const in float dotTL,const in float dotBL,const in float dotNV,const in float dotNL){
float gv=dotNL*length(vec3(alphaT*dotTV,alphaB*dotBV,dotNV));
float gl=dotNV*length(vec3(alphaT*dotTL,alphaB*dotBL,dotNL));
return 0.5 / max(gv + gl,EPSILON);
}
float D_GGX_Anisotropic(const in float alphaT,const in float alphaB,const in float dotNH,const in float dotTH,const in float dotBH){
float a2=alphaT*alphaB;
highp vec3 v=vec3(alphaB*dotTH,alphaT*dotBH,a2*dotNH);
highp float v2=dot(v,v);
float w2=a2 / v2;
return RECIPROCAL_PI*a2*pow2(w2);
}
#endif
#ifdef USE_CLEARCOAT
vec3 BRDF_GGX_Clearcoat(const in vec3 lightDir,const in vec3 viewDir,const in vec3 normal,const in PhysicalMaterial material){
vec3 f0=material.clearcoatF0;
float f90=material.clearcoatF90;
float roughness=max(material.clearcoatRoughness,0.045);
float alpha=pow2(roughness);
vec3 halfDir=normalize(lightDir + viewDir);
float dotNL=saturate(dot(normal,lightDir));
float dotNV=saturate(dot(normal,viewDir));
float dotNH=saturate(dot(normal,halfDir));
float dotVH=saturate(dot(viewDir,halfDir));
vec3 F=F_Schlick(f0,f90,dotVH);
float V=V_GGX_SmithCorrelated(alpha,dotNL,dotNV);
float D=D_GGX(alpha,dotNH);
return F*(V*D);
}
#endif
vec3 BRDF_GGX(const in vec3 lightDir,const in vec3 viewDir,const in vec3 normal,const in PhysicalMaterial material){
vec3 f0=material.specularColorBlended;
float f90=material.specularF90;
float roughness=max(material.roughness,0.045);
float alpha=pow2(roughness);
vec3 halfDir=normalize(lightDir + viewDir);
float dotNL=saturate(dot(normal,lightDir));
float dotNV=saturate(dot(normal,viewDir));
float dotNH=saturate(dot(normal,halfDir));
float dotVH=saturate(dot(viewDir,halfDir));
vec3 F=F_Schlick(f0,f90,dotVH);
#ifdef USE_IRIDESCENCE
F=mix(F,material.iridescenceFresnel,material.iridescence);
#endif
#ifdef USE_ANISOTROPY
float dotTL=dot(material.anisotropyT,lightDir);
float dotTV=dot(material.anisotropyT,viewDir);
float dotTH=dot(material.anisotropyT,halfDir);
float dotBL=dot(material.anisotropyB,lightDir);
float dotBV=dot(material.anisotropyB,viewDir);
float dotBH=dot(material.anisotropyB,halfDir);
float alphaT=max(material.alphaT,alpha);
float V=V_GGX_SmithCorrelated_Anisotropic(alphaT,alpha,dotTV,dotBV,dotTL,dotBL,dotNV,dotNL);
float D=D_GGX_Anisotropic(alphaT,alpha,dotNH,dotTH,dotBH);
#else
float V=V_GGX_SmithCorrelated(alpha,dotNL,dotNV);
float D=D_GGX(alpha,dotNH);
#endif
return F*(V*D);
}
vec2 LTC_Uv(const in vec3 N,const in vec3 V,const in float roughness){
const float LUT_SIZE=64.0;
const float LUT_SCALE=(LUT_SIZE - 1.0)/ LUT_SIZE;
const float LUT_BIAS=0.5 / LUT_SIZE;
float dotNV=saturate(dot(N,V));
vec2 uv=vec2(roughness,sqrt(1.0 - dotNV));
uv=uv*LUT_SCALE + LUT_BIAS;
return uv;
}
float LTC_ClippedSphereFormFactor(const in vec3 f){
float l=length(f);
return max((l*l + f.z)/(l + 1.0),0.0);
}
vec3 LTC_EdgeVectorFormFactor(const in vec3 v1,const in vec3 v2){
float x=dot(v1,v2);
float y=abs(x);
float a=0.8543985 +(0.4965155 + 0.0145206*y)*y;
float b=3.4175940 +(4.1616724 + y)*y;
float v=a / b;
float theta_sintheta=(x>0.0)?v:0.5*inversesqrt(max(1.0 - x*x,1e-7))- v;
return cross(v1,v2)*theta_sintheta;
}
vec3 LTC_Evaluate(const in vec3 N,const in vec3 V,const in vec3 P,const in mat3 mInv,const in vec3 rectCoords[ 4 ]){
vec3 v1=rectCoords[ 1 ] - rectCoords[ 0 ];
vec3 v2=rectCoords[ 3 ] - rectCoords[ 0 ];
vec3 lightNormal=cross(v1,v2);
if(dot(lightNormal,P - rectCoords[ 0 ])<0.0)return vec3(0.0);
vec3 T1,T2;
T1=normalize(V - N*dot(V,N));
T2=- cross(N,T1);
mat3 mat=mInv*transpose(mat3(T1,T2,N));
vec3 coords[ 4 ];
coords[ 0 ]=mat*(rectCoords[ 0 ] - P);
coords[ 1 ]=mat*(rectCoords[ 1 ] - P);
coords[ 2 ]=mat*(rectCoords[ 2 ] - P);
coords[ 3 ]=mat*(rectCoords[ 3 ] - P);
coords[ 0 ]=normalize(coords[ 0 ]);
coords[ 1 ]=normalize(coords[ 1 ]);
coords[ 2 ]=normalize(coords[ 2 ]);
coords[ 3 ]=normalize(coords[ 3 ]);
vec3 vectorFormFactor=vec3(0.0);
vectorFormFactor +=LTC_EdgeVectorFormFactor(coords[ 0 ],coords[ 1 ]);
vectorFormFactor +=LTC_EdgeVectorFormFactor(coords[ 1 ],coords[ 2 ]);
vectorFormFactor +=LTC_EdgeVectorFormFactor(coords[ 2 ],coords[ 3 ]);
vectorFormFactor +=LTC_EdgeVectorFormFactor(coords[ 3 ],coords[ 0 ]);
float result=LTC_ClippedSphereFormFactor(vectorFormFactor);
return vec3(result);
}
#if defined( USE_SHEEN )
float D_Charlie(float roughness,float dotNH){
float alpha=pow2(roughness);
float invAlpha=1.0 / alpha;
float cos2h=dotNH*dotNH;
float sin2h=max(1.0 - cos2h,0.0078125);
return(2.0 + invAlpha)*pow(sin2h,invAlpha*0.5)/(2.0*PI);
}
float V_Neubelt(float dotNV,float dotNL){
return saturate(1.0 /(4.0*(dotNL + dotNV - dotNL*dotNV)));
}
vec3 BRDF_Sheen(const in vec3 lightDir,const in vec3 viewDir,const in vec3 normal,vec3 sheenColor,const in float sheenRoughness){
vec3 halfDir=normalize(lightDir + viewDir);
float dotNL=saturate(dot(normal,lightDir));
float dotNV=saturate(dot(normal,viewDir));
float dotNH=saturate(dot(normal,halfDir));
float D=D_Charlie(sheenRoughness,dotNH);
float V=V_Neubelt(dotNV,dotNL);
return sheenColor*(D*V);
}
#endif
float IBLSheenBRDF(const in vec3 normal,const in vec3 viewDir,const in float roughness){
float dotNV=saturate(dot(normal,viewDir));
float r2=roughness*roughness;
float rInv=1.0 /(roughness + 0.1);
float a=-1.9362 + 1.0678*roughness + 0.4573*r2 - 0.8469*rInv;
float b=-0.6014 + 0.5538*roughness - 0.4670*r2 - 0.1255*rInv;
float DG=exp(a*dotNV + b);
return saturate(DG);
}
vec3 EnvironmentBRDF(const in vec3 normal,const in vec3 viewDir,const in vec3 specularColor,const in float specularF90,const in float roughness){
float dotNV=saturate(dot(normal,viewDir));
vec2 fab=texture2D(dfgLUT,vec2(roughness,dotNV)).rg;
return specularColor*fab.x + specularF90*fab.y;
}
#ifdef USE_IRIDESCENCE
void computeMultiscatteringIridescence(const in vec2 fab,const in vec3 specularColor,const in float specularF90,const in float iridescence,const in vec3 iridescenceF0,inout vec3 singleScatter,inout vec3 multiScatter){
#else
void computeMultiscattering(const in vec2 fab,const in vec3 specularColor,const in float specularF90,inout vec3 singleScatter,inout vec3 multiScatter){
#endif
#ifdef USE_IRIDESCENCE
vec3 Fr=mix(specularColor,iridescenceF0,iridescence);
#else
vec3 Fr=specularColor;
#endif
vec3 FssEss=Fr*fab.x + specularF90*fab.y;
float Ess=fab.x + fab.y;
float Ems=1.0 - Ess;
vec3 Favg=Fr +(1.0 - Fr)*0.047619;vec3 Fms=FssEss*Favg /(1.0 - Ems*Favg);
singleScatter +=FssEss;
multiScatter +=Fms*Ems;
}
#if NUM_RECT_AREA_LIGHTS > 0
void RE_Direct_RectArea_Physical(const in RectAreaLight rectAreaLight,const in vec3 geometryPosition,const in vec3 geometryNormal,const in vec3 geometryViewDir,const in vec3 geometryClearcoatNormal,const in PhysicalMaterial material,inout ReflectedLight reflectedLight){
vec3 normal=geometryNormal;
vec3 viewDir=geometryViewDir;
vec3 position=geometryPosition;
vec3 lightPos=rectAreaLight.position;
vec3 halfWidth=rectAreaLight.halfWidth;
vec3 halfHeight=rectAreaLight.halfHeight;
vec3 lightColor=rectAreaLight.color;
float roughness=material.roughness;
vec3 rectCoords[ 4 ];
rectCoords[ 0 ]=lightPos + halfWidth - halfHeight;rectCoords[ 1 ]=lightPos - halfWidth - halfHeight;
rectCoords[ 2 ]=lightPos - halfWidth + halfHeight;
rectCoords[ 3 ]=lightPos + halfWidth + halfHeight;
vec2 uv=LTC_Uv(normal,viewDir,roughness);
vec4 t1=texture2D(ltc_1,uv);
vec4 t2=texture2D(ltc_2,uv);
mat3 mInv=mat3(
vec3(t1.x,0,t1.y),
vec3(0,1,0),
vec3(t1.z,0,t1.w)
);
vec3 fresnel=(material.specularColorBlended*t2.x +(material.specularF90 - material.specularColorBlended)*t2.y);
reflectedLight.directSpecular +=lightColor*fresnel*LTC_Evaluate(normal,viewDir,position,mInv,rectCoords);
reflectedLight.directDiffuse +=lightColor*material.diffuseContribution*LTC_Evaluate(normal,viewDir,position,mat3(1.0),rectCoords);
#ifdef USE_CLEARCOAT
vec3 Ncc=geometryClearcoatNormal;
vec2 uvClearcoat=LTC_Uv(Ncc,viewDir,material.clearcoatRoughness);
vec4 t1Clearcoat=texture2D(ltc_1,uvClearcoat);
vec4 t2Clearcoat=texture2D(ltc_2,uvClearcoat);
mat3 mInvClearcoat=mat3(
vec3(t1Clearcoat.x,0,t1Clearcoat.y),
vec3(0,1,0),
vec3(t1Clearcoat.z,0,t1Clearcoat.w)
);
vec3 fresnelClearcoat=material.clearcoatF0*t2Clearcoat.x +(material.clearcoatF90 - material.clearcoatF0)*t2Clearcoat.y;
clearcoatSpecularDirect +=lightColor*fresnelClearcoat*LTC_Evaluate(Ncc,viewDir,position,mInvClearcoat,rectCoords);
#endif
}
#endif
void RE_Direct_Physical(const in IncidentLight directLight,const in vec3 geometryPosition,const in vec3 geometryNormal,const in vec3 geometryViewDir,const in vec3 geometryClearcoatNormal,const in PhysicalMaterial material,inout ReflectedLight reflectedLight){
float dotNL=saturate(dot(geometryNormal,directLight.direction));
vec3 irradiance=dotNL*directLight.color;
#ifdef USE_CLEARCOAT
float dotNLcc=saturate(dot(geometryClearcoatNormal,directLight.direction));
vec3 ccIrradiance=dotNLcc*directLight.color;
clearcoatSpecularDirect +=ccIrradiance*BRDF_GGX_Clearcoat(directLight.direction,geometryViewDir,geometryClearcoatNormal,material);
#endif
#ifdef USE_SHEEN
sheenSpecularDirect +=irradiance*BRDF_Sheen(directLight.direction,geometryViewDir,geometryNormal,material.sheenColor,material.sheenRoughness);
float sheenAlbedoV=IBLSheenBRDF(geometryNormal,geometryViewDir,material.sheenRoughness);
float sheenAlbedoL=IBLSheenBRDF(geometryNormal,directLight.direction,material.sheenRoughness);
float sheenEnergyComp=1.0 - max3(material.sheenColor)*max(sheenAlbedoV,sheenAlbedoL);
irradiance*=sheenEnergyComp;
#endif
vec3 specularBRDF=BRDF_GGX(directLight.direction,geometryViewDir,geometryNormal,material);
#ifdef USE_RETROREFLECTION
vec3 retroViewDir=reflect(- geometryViewDir,geometryNormal);
vec3 retroSpecularBRDF=BRDF_GGX(directLight.direction,retroViewDir,geometryNormal,material);
specularBRDF=mix(specularBRDF,retroSpecularBRDF,saturate(material.retroreflectivity));
#endif
reflectedLight.directSpecular +=irradiance*specularBRDF*material.multiScatteringCompensation;
vec3 halfDir=normalize(directLight.direction + geometryViewDir);
float dotVH=saturate(dot(geometryViewDir,halfDir));
vec3 F=F_Schlick(material.specularColor,material.specularF90,dotVH);
#ifdef USE_RETROREFLECTION
vec3 retroHalfDir=normalize(directLight.direction + retroViewDir);
float dotRetroVH=saturate(dot(retroViewDir,retroHalfDir));
vec3 retroF=F_Schlick(material.specularColor,material.specularF90,dotRetroVH);
F=mix(F,retroF,saturate(material.retroreflectivity));
#endif
#ifdef USE_DIFFUSE_ROUGHNESS
vec3 diffuseBRDF=BRDF_EON(directLight.direction,geometryViewDir,geometryNormal,material.diffuseColor,material.diffuseRoughness)*(1.0 - material.metalness);
#else
vec3 diffuseBRDF=BRDF_Lambert(material.diffuseContribution);
#endif
reflectedLight.directDiffuse +=irradiance*diffuseBRDF*(1.0 - F);
}
void RE_IndirectDiffuse_Physical(const in vec3 irradiance,const in vec3 geometryPosition,const in vec3 geometryNormal,const in vec3 geometryViewDir,const in vec3 geometryClearcoatNormal,const in PhysicalMaterial material,inout ReflectedLight reflectedLight){
vec3 singleScattering=vec3(0.0);
vec3 multiScattering=vec3(0.0);
#ifdef USE_IRIDESCENCE
computeMultiscatteringIridescence(material.dfg,material.specularColor,material.specularF90,material.iridescence,material.iridescenceF0Dielectric,singleScattering,multiScattering);
#else
computeMultiscattering(material.dfg,material.specularColor,material.specularF90,singleScattering,multiScattering);
#endif
#ifdef USE_DIFFUSE_ROUGHNESS
float dotNV=saturate(dot(geometryNormal,geometryViewDir));
vec3 diffuseAlbedo=EON_DirectionalAlbedo(material.diffuseColor,material.diffuseRoughness,dotNV)*(1.0 - material.metalness);
vec3 diffuse=irradiance*RECIPROCAL_PI*diffuseAlbedo*(1.0 - singleScattering - multiScattering);
#else
vec3 diffuse=irradiance*BRDF_Lambert(material.diffuseContribution)*(1.0 - singleScattering - multiScattering);
#endif
#ifdef USE_SHEEN
float sheenAlbedo=IBLSheenBRDF(geometryNormal,geometryViewDir,material.sheenRoughness);
sheenSpecularIndirect +=irradiance*material.sheenColor*sheenAlbedo*RECIPROCAL_PI;
float sheenEnergyComp=1.0 - max3(material.sheenColor)*sheenAlbedo;
diffuse*=sheenEnergyComp;
#endif
reflectedLight.indirectDiffuse +=diffuse;
}
void RE_IndirectSpecular_Physical(const in vec3 radiance,const in vec3 irradiance,const in vec3 clearcoatRadiance,const in vec3 geometryPosition,const in vec3 geometryNormal,const in vec3 geometryViewDir,const in vec3 geometryClearcoatNormal,const in PhysicalMaterial material,inout ReflectedLight reflectedLight){
#ifdef USE_CLEARCOAT
clearcoatSpecularIndirect +=clearcoatRadiance*EnvironmentBRDF(geometryClearcoatNormal,geometryViewDir,material.clearcoatF0,material.clearcoatF90,material.clearcoatRoughness);
#endif
#ifdef USE_SHEEN
sheenSpecularIndirect +=irradiance*material.sheenColor*IBLSheenBRDF(geometryNormal,geometryViewDir,material.sheenRoughness)*RECIPROCAL_PI;
#endif
vec3 singleScatteringDielectric=vec3(0.0);
vec3 multiScatteringDielectric=vec3(0.0);
vec3 singleScatteringMetallic=vec3(0.0);
vec3 multiScatteringMetallic=vec3(0.0);
#ifdef USE_IRIDESCENCE
computeMultiscatteringIridescence(material.dfg,material.specularColor,material.specularF90,material.iridescence,material.iridescenceF0Dielectric,singleScatteringDielectric,multiScatteringDielectric);
computeMultiscatteringIridescence(material.dfg,material.diffuseColor,material.specularF90,material.iridescence,material.iridescenceF0Metallic,singleScatteringMetallic,multiScatteringMetallic);
#else
computeMultiscattering(material.dfg,material.specularColor,material.specularF90,singleScatteringDielectric,multiScatteringDielectric);
computeMultiscattering(material.dfg,material.diffuseColor,material.specularF90,singleScatteringMetallic,multiScatteringMetallic);
#endif
vec3 singleScattering=mix(singleScatteringDielectric,singleScatteringMetallic,material.metalness);
vec3 multiScattering=mix(multiScatteringDielectric,multiScatteringMetallic,material.metalness);
vec3 totalScatteringDielectric=singleScatteringDielectric + multiScatteringDielectric;
#ifdef USE_DIFFUSE_ROUGHNESS
float dotNV=saturate(dot(geometryNormal,geometryViewDir));
vec3 diffuse=EON_DirectionalAlbedo(material.diffuseColor,material.diffuseRoughness,dotNV)*(1.0 - material.metalness)*(1.0 - totalScatteringDielectric);
#else
vec3 diffuse=material.diffuseContribution*(1.0 - totalScatteringDielectric);
#endif
vec3 cosineWeightedIrradiance=irradiance*RECIPROCAL_PI;
vec3 indirectSpecular=radiance*singleScattering;
indirectSpecular +=multiScattering*cosineWeightedIrradiance;
vec3 indirectDiffuse=diffuse*cosineWeightedIrradiance;
#ifdef USE_SHEEN
float sheenAlbedo=IBLSheenBRDF(geometryNormal,geometryViewDir,material.sheenRoughness);
float sheenEnergyComp=1.0 - max3(material.sheenColor)*sheenAlbedo;
indirectSpecular*=sheenEnergyComp;
indirectDiffuse*=sheenEnergyComp;
#endif
reflectedLight.indirectSpecular +=indirectSpecular;
reflectedLight.indirectDiffuse +=indirectDiffuse;
}
#define RE_Direct    RE_Direct_Physical
#define RE_Direct_RectArea  RE_Direct_RectArea_Physical
#define RE_IndirectDiffuse  RE_IndirectDiffuse_Physical
#define RE_IndirectSpecular  RE_IndirectSpecular_Physical
float computeSpecularOcclusion(const in float dotNV,const in float ambientOcclusion,const in float roughness){
return saturate(pow(dotNV + ambientOcclusion,exp2(- 16.0*roughness - 1.0))- 1.0 + ambientOcclusion);
}`,Fm=`vec3 geometryPosition=- vViewPosition;
vec3 geometryNormal=normal;
vec3 geometryViewDir=(isOrthographic)?vec3(0,0,1):normalize(vViewPosition);
vec3 geometryClearcoatNormal=vec3(0.0);
#ifdef USE_CLEARCOAT
geometryClearcoatNormal=clearcoatNormal;
#endif
#ifdef USE_IRIDESCENCE
float dotNVi=saturate(dot(normal,geometryViewDir));
if(material.iridescenceThickness==0.0){
material.iridescence=0.0;
}else{
material.iridescence=saturate(material.iridescence);
}
if(material.iridescence>0.0){
vec3 iridescenceFresnelDielectric=evalIridescence(1.0,material.iridescenceIOR,dotNVi,material.iridescenceThickness,material.specularColor);
vec3 iridescenceFresnelMetallic=evalIridescence(1.0,material.iridescenceIOR,dotNVi,material.iridescenceThickness,material.diffuseColor);
material.iridescenceFresnel=mix(iridescenceFresnelDielectric,iridescenceFresnelMetallic,material.metalness);
material.iridescenceF0Dielectric=Schlick_to_F0(iridescenceFresnelDielectric,1.0,dotNVi);
material.iridescenceF0Metallic=Schlick_to_F0(iridescenceFresnelMetallic,1.0,dotNVi);
}
#endif
#ifdef STANDARD
float dotNVms=saturate(dot(geometryNormal,geometryViewDir));
material.dfg=texture2D(dfgLUT,vec2(material.roughness,dotNVms)).rg;
#if ( NUM_SUN_LIGHTS > 0 || NUM_DIR_LIGHTS > 0 || NUM_POINT_LIGHTS > 0 || NUM_SPOT_LIGHTS > 0 )
float EssMs=material.dfg.x + material.dfg.y;
material.multiScatteringCompensation=1.0 + material.specularColorBlended*(1.0 / EssMs - 1.0);
#endif
#endif
IncidentLight directLight;
#if ( NUM_POINT_LIGHTS > 0 ) && defined( RE_Direct )
PointLight pointLight;
#if defined( USE_SHADOWMAP ) && NUM_POINT_LIGHT_SHADOWS > 0
PointLightShadow pointLightShadow;
#endif
#pragma unroll_loop_start
for(int i=0;i<NUM_POINT_LIGHTS;i ++){
pointLight=pointLights[ i ];
getPointLightInfo(pointLight,geometryPosition,directLight);
#if defined( USE_SHADOWMAP ) && ( UNROLLED_LOOP_INDEX < NUM_POINT_LIGHT_SHADOWS ) && ( defined( SHADOWMAP_TYPE_PCF ) || defined( SHADOWMAP_TYPE_BASIC ) )
pointLightShadow=pointLightShadows[ i ];
directLight.color*=(directLight.visible&&receiveShadow)?getPointShadow(pointShadowMap[ i ],pointLightShadow.shadowMapSize,pointLightShadow.shadowIntensity,pointLightShadow.shadowBias,pointLightShadow.shadowRadius,vPointShadowCoord[ i ],pointLightShadow.shadowCameraNear,pointLightShadow.shadowCameraFar):1.0;
#endif
RE_Direct(directLight,geometryPosition,geometryNormal,geometryViewDir,geometryClearcoatNormal,material,reflectedLight);
}
#pragma unroll_loop_end
#endif
#if ( NUM_SPOT_LIGHTS > 0 ) && defined( RE_Direct )
SpotLight spotLight;
vec4 spotColor;
vec3 spotLightCoord;
bool inSpotLightMap;
#if defined( USE_SHADOWMAP ) && NUM_SPOT_LIGHT_SHADOWS > 0
SpotLightShadow spotLightShadow;
#endif
#pragma unroll_loop_start
for(int i=0;i<NUM_SPOT_LIGHTS;i ++){
spotLight=spotLights[ i ];
getSpotLightInfo(spotLight,geometryPosition,directLight);
#if ( UNROLLED_LOOP_INDEX < NUM_SPOT_LIGHT_SHADOWS_WITH_MAPS )
#define SPOT_LIGHT_MAP_INDEX UNROLLED_LOOP_INDEX
#elif ( UNROLLED_LOOP_INDEX < NUM_SPOT_LIGHT_SHADOWS )
#define SPOT_LIGHT_MAP_INDEX NUM_SPOT_LIGHT_MAPS
#else
#define SPOT_LIGHT_MAP_INDEX ( UNROLLED_LOOP_INDEX - NUM_SPOT_LIGHT_SHADOWS + NUM_SPOT_LIGHT_SHADOWS_WITH_MAPS )
#endif
#if ( SPOT_LIGHT_MAP_INDEX < NUM_SPOT_LIGHT_MAPS )
spotLightCoord=vSpotLightCoord[ i ].xyz / vSpotLightCoord[ i ].w;
inSpotLightMap=all(lessThan(abs(spotLightCoord*2. - 1.),vec3(1.0)));
spotColor=texture2D(spotLightMap[ SPOT_LIGHT_MAP_INDEX ],spotLightCoord.xy);
directLight.color=inSpotLightMap?directLight.color*spotColor.rgb:directLight.color;
#endif
#undef SPOT_LIGHT_MAP_INDEX
#if defined( USE_SHADOWMAP ) && ( UNROLLED_LOOP_INDEX < NUM_SPOT_LIGHT_SHADOWS )
spotLightShadow=spotLightShadows[ i ];
directLight.color*=(directLight.visible&&receiveShadow)?getShadow(spotShadowMap[ i ],spotLightShadow.shadowMapSize,spotLightShadow.shadowIntensity,spotLightShadow.shadowBias,spotLightShadow.shadowRadius,vSpotLightCoord[ i ]):1.0;
#endif
RE_Direct(directLight,geometryPosition,geometryNormal,geometryViewDir,geometryClearcoatNormal,material,reflectedLight);
}
#pragma unroll_loop_end
#endif
#if ( NUM_SUN_LIGHTS > 0 ) && defined( RE_Direct )
SunLight sunLight;
#if defined( USE_SHADOWMAP ) && NUM_SUN_LIGHT_SHADOWS > 0
SunLightShadow sunLightShadow;
#endif
#pragma unroll_loop_start
for(int i=0;i<NUM_SUN_LIGHTS;i ++){
sunLight=sunLights[ i ];
getSunLightInfo(sunLight,directLight);
#if defined( USE_SHADOWMAP ) && ( UNROLLED_LOOP_INDEX < NUM_SUN_LIGHT_SHADOWS )
sunLightShadow=sunLightShadows[ i ];
directLight.color*=(directLight.visible&&receiveShadow)?getSunShadow(sunShadowMap[ i ],sunLightShadow,UNROLLED_LOOP_INDEX):1.0;
#endif
RE_Direct(directLight,geometryPosition,geometryNormal,geometryViewDir,geometryClearcoatNormal,material,reflectedLight);
}
#pragma unroll_loop_end
#endif
#if ( NUM_DIR_LIGHTS > 0 ) && defined( RE_Direct )
DirectionalLight directionalLight;
#if defined( USE_SHADOWMAP ) && NUM_DIR_LIGHT_SHADOWS > 0
DirectionalLightShadow directionalLightShadow;
#endif
#pragma unroll_loop_start
for(int i=0;i<NUM_DIR_LIGHTS;i ++){
directionalLight=directionalLights[ i ];
getDirectionalLightInfo(directionalLight,directLight);
#if defined( USE_SHADOWMAP ) && ( UNROLLED_LOOP_INDEX < NUM_DIR_LIGHT_SHADOWS )
directionalLightShadow=directionalLightShadows[ i ];
directLight.color*=(directLight.visible&&receiveShadow)?getShadow(directionalShadowMap[ i ],directionalLightShadow.shadowMapSize,directionalLightShadow.shadowIntensity,directionalLightShadow.shadowBias,directionalLightShadow.shadowRadius,vDirectionalShadowCoord[ i ]):1.0;
#endif
RE_Direct(directLight,geometryPosition,geometryNormal,geometryViewDir,geometryClearcoatNormal,material,reflectedLight);
}
#pragma unroll_loop_end
#endif
#if ( NUM_RECT_AREA_LIGHTS > 0 ) && defined( RE_Direct_RectArea )
RectAreaLight rectAreaLight;
#pragma unroll_loop_start
for(int i=0;i<NUM_RECT_AREA_LIGHTS;i ++){
rectAreaLight=rectAreaLights[ i ];
RE_Direct_RectArea(rectAreaLight,geometryPosition,geometryNormal,geometryViewDir,geometryClearcoatNormal,material,reflectedLight);
}
#pragma unroll_loop_end
#endif
#if defined( RE_IndirectDiffuse )
vec3 iblIrradiance=vec3(0.0);
vec3 irradiance=getAmbientLightIrradiance(ambientLightColor);
#if defined( USE_LIGHT_PROBES )
irradiance +=getLightProbeIrradiance(lightProbe,geometryNormal);
#endif
#if ( NUM_HEMI_LIGHTS > 0 )
#pragma unroll_loop_start
for(int i=0;i<NUM_HEMI_LIGHTS;i ++){
irradiance +=getHemisphereLightIrradiance(hemisphereLights[ i ],geometryNormal);
}
#pragma unroll_loop_end
#endif
#if NUM_LIGHT_PROBE_GRIDS > 0
vec3 probeWorldPos=((vec4(geometryPosition,1.0)- viewMatrix[ 3 ])*viewMatrix).xyz;
vec3 probeWorldNormal=transformNormalByInverseViewMatrix(geometryNormal,viewMatrix);
int probeGrid=- 1;
#pragma unroll_loop_start
for(int i=0;i<NUM_LIGHT_PROBE_GRIDS;i ++){
if(isInsideLightProbeGrid(probeWorldPos,probeWorldNormal,probesMin[ i ],probesMax[ i ],probesResolution[ i ]))probeGrid=UNROLLED_LOOP_INDEX;
}
#pragma unroll_loop_end
#pragma unroll_loop_start
for(int i=0;i<NUM_LIGHT_PROBE_GRIDS;i ++){
if(probeGrid==UNROLLED_LOOP_INDEX)irradiance +=getLightProbeGridIrradiance(probesSH[ i ],probesMin[ i ],probesMax[ i ],probesResolution[ i ],probeWorldPos,probeWorldNormal);
}
#pragma unroll_loop_end
#endif
#endif
#if defined( RE_IndirectSpecular )
vec3 radiance=vec3(0.0);
vec3 clearcoatRadiance=vec3(0.0);
#endif`,Um=`#if defined( RE_IndirectDiffuse )
#ifdef USE_LIGHTMAP
vec4 lightMapTexel=texture2D(lightMap,vLightMapUv);
vec3 lightMapIrradiance=lightMapTexel.rgb*lightMapIntensity;
irradiance +=lightMapIrradiance;
#endif
#if defined( USE_ENVMAP ) && defined( ENVMAP_TYPE_PMREM )
#if defined( STANDARD ) || defined( LAMBERT ) || defined( PHONG )
iblIrradiance +=getIBLIrradiance(geometryNormal);
#endif
#endif
#endif
#if defined( USE_ENVMAP ) && defined( RE_IndirectSpecular )
#ifdef USE_ANISOTROPY
vec3 iblRadiance=getIBLAnisotropyRadiance(geometryViewDir,geometryNormal,material.roughness,material.anisotropyB,material.anisotropy);
#else
vec3 iblRadiance=getIBLRadiance(geometryViewDir,geometryNormal,material.roughness);
#endif
#ifdef USE_RETROREFLECTION
#ifdef USE_ANISOTROPY
vec3 retroIBLRadiance=getIBLAnisotropyRetroRadiance(geometryViewDir,geometryNormal,material.roughness,material.anisotropyB,material.anisotropy);
#else
vec3 retroIBLRadiance=getIBLRetroRadiance(geometryViewDir,geometryNormal,material.roughness);
#endif
iblRadiance=mix(iblRadiance,retroIBLRadiance,saturate(material.retroreflectivity));
#endif
radiance +=iblRadiance;
#ifdef USE_CLEARCOAT
clearcoatRadiance +=getIBLRadiance(geometryViewDir,geometryClearcoatNormal,material.clearcoatRoughness);
#endif
#endif`,Om=`#if defined( RE_IndirectDiffuse )
#if defined( LAMBERT ) || defined( PHONG )
irradiance +=iblIrradiance;
#endif
RE_IndirectDiffuse(irradiance,geometryPosition,geometryNormal,geometryViewDir,geometryClearcoatNormal,material,reflectedLight);
#endif
#if defined( RE_IndirectSpecular )
RE_IndirectSpecular(radiance,iblIrradiance,clearcoatRadiance,geometryPosition,geometryNormal,geometryViewDir,geometryClearcoatNormal,material,reflectedLight);
#endif`,Bm=`#if NUM_LIGHT_PROBE_GRIDS > 0
uniform highp sampler3D probesSH[ NUM_LIGHT_PROBE_GRIDS ];
uniform vec3 probesMin[ NUM_LIGHT_PROBE_GRIDS ];
uniform vec3 probesMax[ NUM_LIGHT_PROBE_GRIDS ];
uniform vec3 probesResolution[ NUM_LIGHT_PROBE_GRIDS ];
bool isInsideLightProbeGrid(vec3 worldPos,vec3 worldNormal,vec3 probesMin,vec3 probesMax,vec3 probesResolution){
vec3 spacing=(probesMax - probesMin)/ probesResolution;
vec3 samplePos=worldPos + worldNormal*spacing*0.5;
vec3 margin=spacing*0.01;
return all(greaterThanEqual(samplePos,probesMin - margin))&&all(lessThanEqual(samplePos,probesMax + margin));
}
vec3 getLightProbeGridIrradiance(highp sampler3D probesSH,vec3 probesMin,vec3 probesMax,vec3 probesResolution,vec3 worldPos,vec3 worldNormal){
vec3 res=probesResolution;
vec3 gridRange=probesMax - probesMin;
vec3 probeSpacing=gridRange / res;
vec3 samplePos=worldPos + worldNormal*probeSpacing*0.5;
vec3 uvw=clamp((samplePos - probesMin)/ gridRange,0.5 / res,1.0 - 0.5 / res);
float nz=res.z;
float paddedSlices=nz + 2.0;
float atlasDepth=7.0*paddedSlices;
float uvZBase=uvw.z*nz + 1.0;
vec4 s0=texture(probesSH,vec3(uvw.xy,(uvZBase)/ atlasDepth));
vec4 s1=texture(probesSH,vec3(uvw.xy,(uvZBase +       paddedSlices)/ atlasDepth));
vec4 s2=texture(probesSH,vec3(uvw.xy,(uvZBase + 2.0*paddedSlices)/ atlasDepth));
vec4 s3=texture(probesSH,vec3(uvw.xy,(uvZBase + 3.0*paddedSlices)/ atlasDepth));
vec4 s4=texture(probesSH,vec3(uvw.xy,(uvZBase + 4.0*paddedSlices)/ atlasDepth));
vec4 s5=texture(probesSH,vec3(uvw.xy,(uvZBase + 5.0*paddedSlices)/ atlasDepth));
vec4 s6=texture(probesSH,vec3(uvw.xy,(uvZBase + 6.0*paddedSlices)/ atlasDepth));
vec3 c0=s0.xyz;
vec3 c1=vec3(s0.w,s1.xy);
vec3 c2=vec3(s1.zw,s2.x);
vec3 c3=s2.yzw;
vec3 c4=s3.xyz;
vec3 c5=vec3(s3.w,s4.xy);
vec3 c6=vec3(s4.zw,s5.x);
vec3 c7=s5.yzw;
vec3 c8=s6.xyz;
float x=worldNormal.x,y=worldNormal.y,z=worldNormal.z;
vec3 result=c0*0.886227;
result +=c1*2.0*0.511664*y;
result +=c2*2.0*0.511664*z;
result +=c3*2.0*0.511664*x;
result +=c4*2.0*0.429043*x*y;
result +=c5*2.0*0.429043*y*z;
result +=c6*(0.743125*z*z - 0.247708);
result +=c7*2.0*0.429043*x*z;
result +=c8*0.429043*(x*x - y*y);
return max(result,vec3(0.0));
}
#endif`,km=`#if defined( USE_LOGARITHMIC_DEPTH_BUFFER )
gl_FragDepth=vIsPerspective==0.0?gl_FragCoord.z:log2(vFragDepth)*logDepthBufFC*0.5;
#endif`,zm=`#if defined( USE_LOGARITHMIC_DEPTH_BUFFER )
uniform float logDepthBufFC;
varying float vFragDepth;
varying float vIsPerspective;
#endif`,Vm=`#ifdef USE_LOGARITHMIC_DEPTH_BUFFER
varying float vFragDepth;
varying float vIsPerspective;
#endif`,Gm=`#ifdef USE_LOGARITHMIC_DEPTH_BUFFER
vFragDepth=1.0 + gl_Position.w;
vIsPerspective=float(isPerspectiveMatrix(projectionMatrix));
#endif`,Hm=`#ifdef USE_MAP
vec4 sampledDiffuseColor=texture2D(map,vMapUv);
#ifdef DECODE_VIDEO_TEXTURE
sampledDiffuseColor=sRGBTransferEOTF(sampledDiffuseColor);
#endif
diffuseColor*=sampledDiffuseColor;
#endif`,Wm=`#ifdef USE_MAP
uniform sampler2D map;
#endif`,Xm=`#if defined( USE_MAP ) || defined( USE_ALPHAMAP )
#if defined( USE_POINTS_UV )
vec2 uv=vUv;
#else
vec2 uv=(uvTransform*vec3(gl_PointCoord.x,1.0 - gl_PointCoord.y,1)).xy;
#endif
#endif
#ifdef USE_MAP
diffuseColor*=texture2D(map,uv);
#endif
#ifdef USE_ALPHAMAP
diffuseColor.a*=texture2D(alphaMap,uv).g;
#endif`,qm=`#if defined( USE_POINTS_UV )
varying vec2 vUv;
#else
#if defined( USE_MAP ) || defined( USE_ALPHAMAP )
uniform mat3 uvTransform;
#endif
#endif
#ifdef USE_MAP
uniform sampler2D map;
#endif
#ifdef USE_ALPHAMAP
uniform sampler2D alphaMap;
#endif`,Ym=`float metalnessFactor=metalness;
#ifdef USE_METALNESSMAP
vec4 texelMetalness=texture2D(metalnessMap,vMetalnessMapUv);
metalnessFactor*=texelMetalness.b;
#endif`,$m=`#ifdef USE_METALNESSMAP
uniform sampler2D metalnessMap;
#endif`,Zm=`#ifdef USE_INSTANCING_MORPH
float morphTargetInfluences[ MORPHTARGETS_COUNT ];
float morphTargetBaseInfluence=texelFetch(morphTexture,ivec2(0,gl_InstanceID),0).r;
for(int i=0;i<MORPHTARGETS_COUNT;i ++){
morphTargetInfluences[i]=texelFetch(morphTexture,ivec2(i + 1,gl_InstanceID),0).r;
}
#endif`,Jm=`#if defined( USE_MORPHCOLORS )
#if defined( USE_COLOR_ALPHA )
vColor*=morphTargetBaseInfluence;
#elif defined( USE_COLOR )
vColor.rgb*=morphTargetBaseInfluence;
#endif
for(int i=0;i<MORPHTARGETS_COUNT;i ++){
#if defined( USE_COLOR_ALPHA )
if(morphTargetInfluences[ i ] !=0.0)vColor +=getMorph(gl_VertexID,i,2)*morphTargetInfluences[ i ];
#elif defined( USE_COLOR )
if(morphTargetInfluences[ i ] !=0.0)vColor.rgb +=getMorph(gl_VertexID,i,2).rgb*morphTargetInfluences[ i ];
#endif
}
#endif`,Km=`#ifdef USE_MORPHNORMALS
objectNormal*=morphTargetBaseInfluence;
for(int i=0;i<MORPHTARGETS_COUNT;i ++){
if(morphTargetInfluences[ i ] !=0.0)objectNormal +=getMorph(gl_VertexID,i,1).xyz*morphTargetInfluences[ i ];
}
#endif`,jm=`#ifdef USE_MORPHTARGETS
#ifndef USE_INSTANCING_MORPH
uniform float morphTargetBaseInfluence;
uniform float morphTargetInfluences[ MORPHTARGETS_COUNT ];
#endif
uniform sampler2DArray morphTargetsTexture;
uniform ivec2 morphTargetsTextureSize;
vec4 getMorph(const in int vertexIndex,const in int morphTargetIndex,const in int offset){
int texelIndex=vertexIndex*MORPHTARGETS_TEXTURE_STRIDE + offset;
int y=texelIndex / morphTargetsTextureSize.x;
int x=texelIndex - y*morphTargetsTextureSize.x;
ivec3 morphUV=ivec3(x,y,morphTargetIndex);
return texelFetch(morphTargetsTexture,morphUV,0);
}
#endif`,Qm=`#ifdef USE_MORPHTARGETS
transformed*=morphTargetBaseInfluence;
for(int i=0;i<MORPHTARGETS_COUNT;i ++){
if(morphTargetInfluences[ i ] !=0.0)transformed +=getMorph(gl_VertexID,i,0).xyz*morphTargetInfluences[ i ];
}
#endif`,eg=`float faceDirection=gl_FrontFacing?1.0:- 1.0;
#ifdef FLAT_SHADED
vec3 fdx=dFdx(vViewPosition);
vec3 fdy=dFdy(vViewPosition);
vec3 normal=normalize(cross(fdx,fdy));
#else
vec3 normal=normalize(vNormal);
#ifdef DOUBLE_SIDED
normal*=faceDirection;
#endif
#endif
#if defined( USE_NORMALMAP_TANGENTSPACE ) || defined( USE_CLEARCOAT_NORMALMAP ) || defined( USE_ANISOTROPY )
#ifdef USE_TANGENT
mat3 tbn=mat3(normalize(vTangent),normalize(vBitangent),normal);
#else
mat3 tbn=getTangentFrame(- vViewPosition,normal,
#if defined( USE_NORMALMAP )
vNormalMapUv
#elif defined( USE_CLEARCOAT_NORMALMAP )
vClearcoatNormalMapUv
#else
vUv
#endif
);
#endif
#ifdef DOUBLE_SIDED
tbn[0]*=faceDirection;
tbn[1]*=faceDirection;
#endif
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
#ifdef USE_TANGENT
mat3 tbn2=mat3(normalize(vTangent),normalize(vBitangent),normal);
#else
mat3 tbn2=getTangentFrame(- vViewPosition,normal,vClearcoatNormalMapUv);
#endif
#ifdef DOUBLE_SIDED
tbn2[0]*=faceDirection;
tbn2[1]*=faceDirection;
#endif
#endif
vec3 nonPerturbedNormal=normal;`,tg=`#ifdef USE_NORMALMAP_OBJECTSPACE
normal=texture2D(normalMap,vNormalMapUv).xyz*2.0 - 1.0;
#ifdef FLIP_SIDED
normal=- normal;
#endif
#ifdef DOUBLE_SIDED
normal=normal*faceDirection;
#endif
normal=normalize(normalMatrix*normal);
#elif defined( USE_NORMALMAP_TANGENTSPACE )
vec3 mapN=texture2D(normalMap,vNormalMapUv).xyz*2.0 - 1.0;
#if defined( USE_PACKED_NORMALMAP )
mapN=vec3(mapN.xy,sqrt(saturate(1.0 - dot(mapN.xy,mapN.xy))));
#endif
mapN.xy*=normalScale;
normal=normalize(tbn*mapN);
#elif defined( USE_BUMPMAP )
normal=perturbNormalArb(- vViewPosition,normal,dHdxy_fwd(),faceDirection);
#endif`,ng=`#ifndef FLAT_SHADED
varying vec3 vNormal;
#ifdef USE_TANGENT
varying vec3 vTangent;
varying vec3 vBitangent;
#endif
#endif`,ig=`#ifndef FLAT_SHADED
varying vec3 vNormal;
#ifdef USE_TANGENT
varying vec3 vTangent;
varying vec3 vBitangent;
#endif
#endif`,sg=`#ifndef FLAT_SHADED
vNormal=normalize(transformedNormal);
#ifdef USE_TANGENT
vTangent=normalize(transformedTangent);
vBitangent=normalize(cross(vNormal,vTangent)*tangent.w);
#ifdef FLIP_SIDED
vBitangent=- vBitangent;
#endif
#endif
#endif`,rg=`#ifdef USE_NORMALMAP
uniform sampler2D normalMap;
uniform vec2 normalScale;
#endif
#ifdef USE_NORMALMAP_OBJECTSPACE
uniform mat3 normalMatrix;
#endif
#if ! defined ( USE_TANGENT ) && ( defined ( USE_NORMALMAP_TANGENTSPACE ) || defined ( USE_CLEARCOAT_NORMALMAP ) || defined( USE_ANISOTROPY ) )
mat3 getTangentFrame(vec3 eye_pos,vec3 surf_norm,vec2 uv){
vec3 q0=dFdx(eye_pos.xyz);
vec3 q1=dFdy(eye_pos.xyz);
vec2 st0=dFdx(uv.st);
vec2 st1=dFdy(uv.st);
vec3 N=surf_norm;
vec3 q1perp=cross(q1,N);
vec3 q0perp=cross(N,q0);
vec3 T=q1perp*st0.x + q0perp*st1.x;
vec3 B=q1perp*st0.y + q0perp*st1.y;
float det=max(dot(T,T),dot(B,B));
float scale=(det==0.0)?0.0:inversesqrt(det);
return mat3(T*scale,B*scale,N);
}
#endif`,og=`#ifdef USE_CLEARCOAT
vec3 clearcoatNormal=nonPerturbedNormal;
#endif`,ag=`#ifdef USE_CLEARCOAT_NORMALMAP
vec3 clearcoatMapN=texture2D(clearcoatNormalMap,vClearcoatNormalMapUv).xyz*2.0 - 1.0;
clearcoatMapN.xy*=clearcoatNormalScale;
clearcoatNormal=normalize(tbn2*clearcoatMapN);
#endif`,lg=`#ifdef USE_CLEARCOATMAP
uniform sampler2D clearcoatMap;
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
uniform sampler2D clearcoatNormalMap;
uniform vec2 clearcoatNormalScale;
#endif
#ifdef USE_CLEARCOAT_ROUGHNESSMAP
uniform sampler2D clearcoatRoughnessMap;
#endif`,cg=`#ifdef USE_IRIDESCENCEMAP
uniform sampler2D iridescenceMap;
#endif
#ifdef USE_IRIDESCENCE_THICKNESSMAP
uniform sampler2D iridescenceThicknessMap;
#endif`,hg=`#ifdef OPAQUE
diffuseColor.a=1.0;
#endif
#ifdef USE_TRANSMISSION
diffuseColor.a*=material.transmissionAlpha;
#endif
gl_FragColor=vec4(outgoingLight,diffuseColor.a);`,ug=`vec3 packNormalToRGB(const in vec3 normal){
return normalize(normal)*0.5 + 0.5;
}
vec3 unpackRGBToNormal(const in vec3 rgb){
return 2.0*rgb.xyz - 1.0;
}
const float PackUpscale=256. / 255.;const float UnpackDownscale=255. / 256.;const float ShiftRight8=1. / 256.;
const float Inv255=1. / 255.;
const vec4 PackFactors=vec4(1.0,256.0,256.0*256.0,256.0*256.0*256.0);
const vec2 UnpackFactors2=vec2(UnpackDownscale,1.0 / PackFactors.g);
const vec3 UnpackFactors3=vec3(UnpackDownscale / PackFactors.rg,1.0 / PackFactors.b);
const vec4 UnpackFactors4=vec4(UnpackDownscale / PackFactors.rgb,1.0 / PackFactors.a);
vec4 packDepthToRGBA(const in float v){
if(v<=0.0)
return vec4(0.,0.,0.,0.);
if(v>=1.0)
return vec4(1.,1.,1.,1.);
float vuf;
float af=modf(v*PackFactors.a,vuf);
float bf=modf(vuf*ShiftRight8,vuf);
float gf=modf(vuf*ShiftRight8,vuf);
return vec4(vuf*Inv255,gf*PackUpscale,bf*PackUpscale,af);
}
vec3 packDepthToRGB(const in float v){
if(v<=0.0)
return vec3(0.,0.,0.);
if(v>=1.0)
return vec3(1.,1.,1.);
float vuf;
float bf=modf(v*PackFactors.b,vuf);
float gf=modf(vuf*ShiftRight8,vuf);
return vec3(vuf*Inv255,gf*PackUpscale,bf);
}
vec2 packDepthToRG(const in float v){
if(v<=0.0)
return vec2(0.,0.);
if(v>=1.0)
return vec2(1.,1.);
float vuf;
float gf=modf(v*256.,vuf);
return vec2(vuf*Inv255,gf);
}
float unpackRGBAToDepth(const in vec4 v){
return dot(v,UnpackFactors4);
}
float unpackRGBToDepth(const in vec3 v){
return dot(v,UnpackFactors3);
}
float unpackRGToDepth(const in vec2 v){
return v.r*UnpackFactors2.r + v.g*UnpackFactors2.g;
}
vec4 pack2HalfToRGBA(const in vec2 v){
vec4 r=vec4(v.x,fract(v.x*255.0),v.y,fract(v.y*255.0));
return vec4(r.x - r.y / 255.0,r.y,r.z - r.w / 255.0,r.w);
}
vec2 unpackRGBATo2Half(const in vec4 v){
return vec2(v.x +(v.y / 255.0),v.z +(v.w / 255.0));
}
float viewZToOrthographicDepth(const in float viewZ,const in float near,const in float far){
return(viewZ + near)/(near - far);
}
float orthographicDepthToViewZ(const in float depth,const in float near,const in float far){
#ifdef USE_REVERSED_DEPTH_BUFFER
return depth*(far - near)- far;
#else
return depth*(near - far)- near;
#endif
}
float viewZToPerspectiveDepth(const in float viewZ,const in float near,const in float far){
return((near + viewZ)*far)/((far - near)*viewZ);
}
float perspectiveDepthToViewZ(const in float depth,const in float near,const in float far){
#ifdef USE_REVERSED_DEPTH_BUFFER
return(near*far)/((near - far)*depth - near);
#else
return(near*far)/((far - near)*depth - far);
#endif
}`,dg=`#ifdef PREMULTIPLIED_ALPHA
gl_FragColor.rgb*=gl_FragColor.a;
#endif`,fg=`vec4 mvPosition=vec4(transformed,1.0);
#ifdef USE_BATCHING
mvPosition=batchingMatrix*mvPosition;
#endif
#ifdef USE_INSTANCING
mvPosition=instanceMatrix*mvPosition;
#endif
mvPosition=modelViewMatrix*mvPosition;
gl_Position=projectionMatrix*mvPosition;`,pg=`#ifdef DITHERING
gl_FragColor.rgb=dithering(gl_FragColor.rgb);
#endif`,mg=`#ifdef DITHERING
vec3 dithering(vec3 color){
float grid_position=rand(gl_FragCoord.xy);
vec3 dither_shift_RGB=vec3(0.25 / 255.0,-0.25 / 255.0,0.25 / 255.0);
dither_shift_RGB=mix(2.0*dither_shift_RGB,-2.0*dither_shift_RGB,grid_position);
return color + dither_shift_RGB;
}
#endif`,gg=`float roughnessFactor=roughness;
#ifdef USE_ROUGHNESSMAP
vec4 texelRoughness=texture2D(roughnessMap,vRoughnessMapUv);
roughnessFactor*=texelRoughness.g;
#endif`,yg=`#ifdef USE_ROUGHNESSMAP
uniform sampler2D roughnessMap;
#endif`,xg=`#if NUM_SPOT_LIGHT_COORDS > 0
varying vec4 vSpotLightCoord[ NUM_SPOT_LIGHT_COORDS ];
#endif
#if NUM_SPOT_LIGHT_MAPS > 0
uniform sampler2D spotLightMap[ NUM_SPOT_LIGHT_MAPS ];
#endif
#ifdef USE_SHADOWMAP
#if NUM_SUN_LIGHT_SHADOWS > 0
#define SUN_LIGHT_CASCADES 2
#if defined( SHADOWMAP_TYPE_PCF )
uniform sampler2DShadow sunShadowMap[ NUM_SUN_LIGHT_SHADOWS ];
#else
uniform sampler2D sunShadowMap[ NUM_SUN_LIGHT_SHADOWS ];
#endif
uniform mat4 sunShadowMatrix[ NUM_SUN_LIGHT_SHADOWS*SUN_LIGHT_CASCADES ];
uniform vec4 sunShadowCascade[ NUM_SUN_LIGHT_SHADOWS*SUN_LIGHT_CASCADES ];
varying vec4 vSunShadowWorldPosition;
varying vec3 vSunShadowWorldNormal;
struct SunLightShadow{
float shadowIntensity;
float shadowBias;
float shadowNormalBias;
float shadowRadius;
vec2 shadowMapSize;
};
uniform SunLightShadow sunLightShadows[ NUM_SUN_LIGHT_SHADOWS ];
#endif
#if NUM_DIR_LIGHT_SHADOWS > 0
#if defined( SHADOWMAP_TYPE_PCF )
uniform sampler2DShadow directionalShadowMap[ NUM_DIR_LIGHT_SHADOWS ];
#else
uniform sampler2D directionalShadowMap[ NUM_DIR_LIGHT_SHADOWS ];
#endif
varying vec4 vDirectionalShadowCoord[ NUM_DIR_LIGHT_SHADOWS ];
struct DirectionalLightShadow{
float shadowIntensity;
float shadowBias;
float shadowNormalBias;
float shadowRadius;
vec2 shadowMapSize;
};
uniform DirectionalLightShadow directionalLightShadows[ NUM_DIR_LIGHT_SHADOWS ];
#endif
#if NUM_SPOT_LIGHT_SHADOWS > 0
#if defined( SHADOWMAP_TYPE_PCF )
uniform sampler2DShadow spotShadowMap[ NUM_SPOT_LIGHT_SHADOWS ];
#else
uniform sampler2D spotShadowMap[ NUM_SPOT_LIGHT_SHADOWS ];
#endif
struct SpotLightShadow{
float shadowIntensity;
float shadowBias;
float shadowNormalBias;
float shadowRadius;
vec2 shadowMapSize;
};
uniform SpotLightShadow spotLightShadows[ NUM_SPOT_LIGHT_SHADOWS ];
#endif
#if NUM_POINT_LIGHT_SHADOWS > 0
#if defined( SHADOWMAP_TYPE_PCF )
uniform samplerCubeShadow pointShadowMap[ NUM_POINT_LIGHT_SHADOWS ];
#elif defined( SHADOWMAP_TYPE_BASIC )
uniform samplerCube pointShadowMap[ NUM_POINT_LIGHT_SHADOWS ];
#endif
varying vec4 vPointShadowCoord[ NUM_POINT_LIGHT_SHADOWS ];
struct PointLightShadow{
float shadowIntensity;
float shadowBias;
float shadowNormalBias;
float shadowRadius;
vec2 shadowMapSize;
float shadowCameraNear;
float shadowCameraFar;
};
uniform PointLightShadow pointLightShadows[ NUM_POINT_LIGHT_SHADOWS ];
#endif
#if defined( SHADOWMAP_TYPE_PCF )
float interleavedGradientNoise(vec2 position){
return fract(52.9829189*fract(dot(position,vec2(0.06711056,0.00583715))));
}
vec2 vogelDiskSample(int sampleIndex,int samplesCount,float phi){
const float goldenAngle=2.399963229728653;
float r=sqrt((float(sampleIndex)+ 0.5)/ float(samplesCount));
float theta=float(sampleIndex)*goldenAngle + phi;
return vec2(cos(theta),sin(theta))*r;
}
#endif
#if defined( SHADOWMAP_TYPE_PCF )
float getShadow(sampler2DShadow shadowMap,vec2 shadowMapSize,float shadowIntensity,float shadowBias,float shadowRadius,vec4 shadowCoord){
float shadow=1.0;
shadowCoord.xyz /=shadowCoord.w;
#ifdef USE_REVERSED_DEPTH_BUFFER
shadowCoord.z -=shadowBias;
#else
shadowCoord.z +=shadowBias;
#endif
bool inFrustum=shadowCoord.x>=0.0&&shadowCoord.x<=1.0&&shadowCoord.y>=0.0&&shadowCoord.y<=1.0;
bool frustumTest=inFrustum&&shadowCoord.z<=1.0;
if(frustumTest){
vec2 texelSize=vec2(1.0)/ shadowMapSize;
vec2 radius=shadowRadius*texelSize;
float phi=interleavedGradientNoise(gl_FragCoord.xy)*PI2;
shadow=(
texture(shadowMap,vec3(shadowCoord.xy + vogelDiskSample(0,5,phi)*radius,shadowCoord.z))+
texture(shadowMap,vec3(shadowCoord.xy + vogelDiskSample(1,5,phi)*radius,shadowCoord.z))+
texture(shadowMap,vec3(shadowCoord.xy + vogelDiskSample(2,5,phi)*radius,shadowCoord.z))+
texture(shadowMap,vec3(shadowCoord.xy + vogelDiskSample(3,5,phi)*radius,shadowCoord.z))+
texture(shadowMap,vec3(shadowCoord.xy + vogelDiskSample(4,5,phi)*radius,shadowCoord.z))
)*0.2;
}
return mix(1.0,shadow,shadowIntensity);
}
#elif defined( SHADOWMAP_TYPE_VSM )
float getShadow(sampler2D shadowMap,vec2 shadowMapSize,float shadowIntensity,float shadowBias,float shadowRadius,vec4 shadowCoord){
float shadow=1.0;
shadowCoord.xyz /=shadowCoord.w;
#ifdef USE_REVERSED_DEPTH_BUFFER
shadowCoord.z -=shadowBias;
#else
shadowCoord.z +=shadowBias;
#endif
bool inFrustum=shadowCoord.x>=0.0&&shadowCoord.x<=1.0&&shadowCoord.y>=0.0&&shadowCoord.y<=1.0;
bool frustumTest=inFrustum&&shadowCoord.z<=1.0;
if(frustumTest){
vec2 distribution=texture2D(shadowMap,shadowCoord.xy).rg;
float mean=distribution.x;
float variance=distribution.y*distribution.y;
#ifdef USE_REVERSED_DEPTH_BUFFER
float hard_shadow=step(mean,shadowCoord.z);
#else
float hard_shadow=step(shadowCoord.z,mean);
#endif
if(hard_shadow==1.0){
shadow=1.0;
}else{
variance=max(variance,0.0000001);
float d=shadowCoord.z - mean;
float p_max=variance /(variance + d*d);
p_max=clamp((p_max - 0.3)/ 0.65,0.0,1.0);
shadow=max(hard_shadow,p_max);
}
}
return mix(1.0,shadow,shadowIntensity);
}
#else
float getShadow(sampler2D shadowMap,vec2 shadowMapSize,float shadowIntensity,float shadowBias,float shadowRadius,vec4 shadowCoord){
float shadow=1.0;
shadowCoord.xyz /=shadowCoord.w;
#ifdef USE_REVERSED_DEPTH_BUFFER
shadowCoord.z -=shadowBias;
#else
shadowCoord.z +=shadowBias;
#endif
bool inFrustum=shadowCoord.x>=0.0&&shadowCoord.x<=1.0&&shadowCoord.y>=0.0&&shadowCoord.y<=1.0;
bool frustumTest=inFrustum&&shadowCoord.z<=1.0;
if(frustumTest){
float depth=texture2D(shadowMap,shadowCoord.xy).r;
#ifdef USE_REVERSED_DEPTH_BUFFER
shadow=step(depth,shadowCoord.z);
#else
shadow=step(shadowCoord.z,depth);
#endif
}
return mix(1.0,shadow,shadowIntensity);
}
#endif
#if NUM_SUN_LIGHT_SHADOWS > 0
float getSunShadow(
#if defined( SHADOWMAP_TYPE_PCF )
sampler2DShadow shadowMap,
#else
sampler2D shadowMap,
#endif
SunLightShadow sunLightShadow,
int shadowIndex
){
vec4 shadowWorldPosition=vec4(vSunShadowWorldPosition.xyz + vSunShadowWorldNormal*sunLightShadow.shadowNormalBias,1.0);
float viewDepth=vSunShadowWorldPosition.w;
int cascadeOffset=shadowIndex*SUN_LIGHT_CASCADES;
float shadow=1.0;
for(int i=SUN_LIGHT_CASCADES - 1;i>=0;i --){
vec4 cascade=sunShadowCascade[ cascadeOffset + i ];
if(viewDepth>=cascade.x&&viewDepth<cascade.y){
float cascadeShadow=getShadow(
shadowMap,
sunLightShadow.shadowMapSize,
sunLightShadow.shadowIntensity,
sunLightShadow.shadowBias,
sunLightShadow.shadowRadius,
sunShadowMatrix[ cascadeOffset + i ]*shadowWorldPosition
);
shadow=mix(cascadeShadow,shadow,smoothstep(cascade.z,cascade.y,viewDepth));
}
}
return shadow;
}
#endif
#if NUM_POINT_LIGHT_SHADOWS > 0
#if defined( SHADOWMAP_TYPE_PCF )
float getPointShadow(samplerCubeShadow shadowMap,vec2 shadowMapSize,float shadowIntensity,float shadowBias,float shadowRadius,vec4 shadowCoord,float shadowCameraNear,float shadowCameraFar){
float shadow=1.0;
vec3 lightToPosition=shadowCoord.xyz;
vec3 bd3D=normalize(lightToPosition);
vec3 absVec=abs(lightToPosition);
float viewSpaceZ=max(max(absVec.x,absVec.y),absVec.z);
if(viewSpaceZ - shadowCameraFar<=0.0&&viewSpaceZ - shadowCameraNear>=0.0){
float lightDistance=length(lightToPosition);
float depthRange=shadowCameraFar - shadowCameraNear;
#ifdef USE_REVERSED_DEPTH_BUFFER
float depthA=- shadowCameraNear / depthRange - shadowBias;
float depthB=shadowCameraNear*shadowCameraFar /(depthRange*lightDistance);
#else
float depthA=shadowCameraFar / depthRange + shadowBias;
float depthB=- shadowCameraNear*shadowCameraFar /(depthRange*lightDistance);
#endif
float texelSize=shadowRadius / shadowMapSize.x;
vec3 absDir=abs(bd3D);
vec3 tangent=absDir.x>absDir.z?vec3(0.0,1.0,0.0):vec3(1.0,0.0,0.0);
tangent=normalize(cross(bd3D,tangent));
vec3 bitangent=cross(bd3D,tangent);
float phi=interleavedGradientNoise(gl_FragCoord.xy)*PI2;
shadow=0.0;
for(int i=0;i<5;i ++){
vec2 offset=vogelDiskSample(i,5,phi);
vec3 direction=bd3D +(tangent*offset.x + bitangent*offset.y)*texelSize;
vec3 absDirection=abs(direction);
float dp=depthA + depthB / max(max(absDirection.x,absDirection.y),absDirection.z);
shadow +=texture(shadowMap,vec4(direction,dp));
}
shadow*=0.2;
}
return mix(1.0,shadow,shadowIntensity);
}
#elif defined( SHADOWMAP_TYPE_BASIC )
float getPointShadow(samplerCube shadowMap,vec2 shadowMapSize,float shadowIntensity,float shadowBias,float shadowRadius,vec4 shadowCoord,float shadowCameraNear,float shadowCameraFar){
float shadow=1.0;
vec3 lightToPosition=shadowCoord.xyz;
vec3 absVec=abs(lightToPosition);
float viewSpaceZ=max(max(absVec.x,absVec.y),absVec.z);
if(viewSpaceZ - shadowCameraFar<=0.0&&viewSpaceZ - shadowCameraNear>=0.0){
float dp=(shadowCameraFar*(viewSpaceZ - shadowCameraNear))/(viewSpaceZ*(shadowCameraFar - shadowCameraNear));
dp +=shadowBias;
vec3 bd3D=normalize(lightToPosition);
float depth=textureCube(shadowMap,bd3D).r;
#ifdef USE_REVERSED_DEPTH_BUFFER
depth=1.0 - depth;
#endif
shadow=step(dp,depth);
}
return mix(1.0,shadow,shadowIntensity);
}
#endif
#endif
#endif`,vg=`#if NUM_SPOT_LIGHT_COORDS > 0
uniform mat4 spotLightMatrix[ NUM_SPOT_LIGHT_COORDS ];
varying vec4 vSpotLightCoord[ NUM_SPOT_LIGHT_COORDS ];
#endif
#ifdef USE_SHADOWMAP
#if NUM_SUN_LIGHT_SHADOWS > 0
varying vec4 vSunShadowWorldPosition;
varying vec3 vSunShadowWorldNormal;
#endif
#if NUM_DIR_LIGHT_SHADOWS > 0
uniform mat4 directionalShadowMatrix[ NUM_DIR_LIGHT_SHADOWS ];
varying vec4 vDirectionalShadowCoord[ NUM_DIR_LIGHT_SHADOWS ];
struct DirectionalLightShadow{
float shadowIntensity;
float shadowBias;
float shadowNormalBias;
float shadowRadius;
vec2 shadowMapSize;
};
uniform DirectionalLightShadow directionalLightShadows[ NUM_DIR_LIGHT_SHADOWS ];
#endif
#if NUM_SPOT_LIGHT_SHADOWS > 0
struct SpotLightShadow{
float shadowIntensity;
float shadowBias;
float shadowNormalBias;
float shadowRadius;
vec2 shadowMapSize;
};
uniform SpotLightShadow spotLightShadows[ NUM_SPOT_LIGHT_SHADOWS ];
#endif
#if NUM_POINT_LIGHT_SHADOWS > 0
uniform mat4 pointShadowMatrix[ NUM_POINT_LIGHT_SHADOWS ];
varying vec4 vPointShadowCoord[ NUM_POINT_LIGHT_SHADOWS ];
struct PointLightShadow{
float shadowIntensity;
float shadowBias;
float shadowNormalBias;
float shadowRadius;
vec2 shadowMapSize;
float shadowCameraNear;
float shadowCameraFar;
};
uniform PointLightShadow pointLightShadows[ NUM_POINT_LIGHT_SHADOWS ];
#endif
#endif`,_g=`#if ( defined( USE_SHADOWMAP ) && ( NUM_DIR_LIGHT_SHADOWS > 0 || NUM_SUN_LIGHT_SHADOWS > 0 || NUM_POINT_LIGHT_SHADOWS > 0 ) ) || ( NUM_SPOT_LIGHT_COORDS > 0 )
#ifdef HAS_NORMAL
vec3 shadowWorldNormal=transformNormalByInverseViewMatrix(transformedNormal,viewMatrix);
#else
vec3 shadowWorldNormal=vec3(0.0);
#endif
vec4 shadowWorldPosition;
#endif
#if defined( USE_SHADOWMAP )
#if NUM_SUN_LIGHT_SHADOWS > 0
vSunShadowWorldPosition=vec4(worldPosition.xyz,- mvPosition.z);
vSunShadowWorldNormal=shadowWorldNormal;
#endif
#if NUM_DIR_LIGHT_SHADOWS > 0
#pragma unroll_loop_start
for(int i=0;i<NUM_DIR_LIGHT_SHADOWS;i ++){
shadowWorldPosition=worldPosition + vec4(shadowWorldNormal*directionalLightShadows[ i ].shadowNormalBias,0);
vDirectionalShadowCoord[ i ]=directionalShadowMatrix[ i ]*shadowWorldPosition;
}
#pragma unroll_loop_end
#endif
#if NUM_POINT_LIGHT_SHADOWS > 0
#pragma unroll_loop_start
for(int i=0;i<NUM_POINT_LIGHT_SHADOWS;i ++){
shadowWorldPosition=worldPosition + vec4(shadowWorldNormal*pointLightShadows[ i ].shadowNormalBias,0);
vPointShadowCoord[ i ]=pointShadowMatrix[ i ]*shadowWorldPosition;
}
#pragma unroll_loop_end
#endif
#endif
#if NUM_SPOT_LIGHT_COORDS > 0
#pragma unroll_loop_start
for(int i=0;i<NUM_SPOT_LIGHT_COORDS;i ++){
shadowWorldPosition=worldPosition;
#if ( defined( USE_SHADOWMAP ) && UNROLLED_LOOP_INDEX < NUM_SPOT_LIGHT_SHADOWS )
shadowWorldPosition.xyz +=shadowWorldNormal*spotLightShadows[ i ].shadowNormalBias;
#endif
vSpotLightCoord[ i ]=spotLightMatrix[ i ]*shadowWorldPosition;
}
#pragma unroll_loop_end
#endif`,bg=`float getShadowMask(){
float shadow=1.0;
#ifdef USE_SHADOWMAP
#if NUM_SUN_LIGHT_SHADOWS > 0
SunLightShadow sunLight;
#pragma unroll_loop_start
for(int i=0;i<NUM_SUN_LIGHT_SHADOWS;i ++){
sunLight=sunLightShadows[ i ];
shadow*=receiveShadow?getSunShadow(sunShadowMap[ i ],sunLight,UNROLLED_LOOP_INDEX):1.0;
}
#pragma unroll_loop_end
#endif
#if NUM_DIR_LIGHT_SHADOWS > 0
DirectionalLightShadow directionalLight;
#pragma unroll_loop_start
for(int i=0;i<NUM_DIR_LIGHT_SHADOWS;i ++){
directionalLight=directionalLightShadows[ i ];
shadow*=receiveShadow?getShadow(directionalShadowMap[ i ],directionalLight.shadowMapSize,directionalLight.shadowIntensity,directionalLight.shadowBias,directionalLight.shadowRadius,vDirectionalShadowCoord[ i ]):1.0;
}
#pragma unroll_loop_end
#endif
#if NUM_SPOT_LIGHT_SHADOWS > 0
SpotLightShadow spotLight;
#pragma unroll_loop_start
for(int i=0;i<NUM_SPOT_LIGHT_SHADOWS;i ++){
spotLight=spotLightShadows[ i ];
shadow*=receiveShadow?getShadow(spotShadowMap[ i ],spotLight.shadowMapSize,spotLight.shadowIntensity,spotLight.shadowBias,spotLight.shadowRadius,vSpotLightCoord[ i ]):1.0;
}
#pragma unroll_loop_end
#endif
#if NUM_POINT_LIGHT_SHADOWS > 0 && ( defined( SHADOWMAP_TYPE_PCF ) || defined( SHADOWMAP_TYPE_BASIC ) )
PointLightShadow pointLight;
#pragma unroll_loop_start
for(int i=0;i<NUM_POINT_LIGHT_SHADOWS;i ++){
pointLight=pointLightShadows[ i ];
shadow*=receiveShadow?getPointShadow(pointShadowMap[ i ],pointLight.shadowMapSize,pointLight.shadowIntensity,pointLight.shadowBias,pointLight.shadowRadius,vPointShadowCoord[ i ],pointLight.shadowCameraNear,pointLight.shadowCameraFar):1.0;
}
#pragma unroll_loop_end
#endif
#endif
return shadow;
}`,Mg=`#ifdef USE_SKINNING
mat4 boneMatX=getBoneMatrix(skinIndex.x);
mat4 boneMatY=getBoneMatrix(skinIndex.y);
mat4 boneMatZ=getBoneMatrix(skinIndex.z);
mat4 boneMatW=getBoneMatrix(skinIndex.w);
#endif`,Sg=`#ifdef USE_SKINNING
uniform mat4 bindMatrix;
uniform mat4 bindMatrixInverse;
uniform highp sampler2D boneTexture;
mat4 getBoneMatrix(const in float i){
int size=textureSize(boneTexture,0).x;
int j=int(i)*4;
int x=j % size;
int y=j / size;
vec4 v1=texelFetch(boneTexture,ivec2(x,y),0);
vec4 v2=texelFetch(boneTexture,ivec2(x + 1,y),0);
vec4 v3=texelFetch(boneTexture,ivec2(x + 2,y),0);
vec4 v4=texelFetch(boneTexture,ivec2(x + 3,y),0);
return mat4(v1,v2,v3,v4);
}
#endif`,wg=`#ifdef USE_SKINNING
vec4 skinVertex=bindMatrix*vec4(transformed,1.0);
vec4 skinned=vec4(0.0);
skinned +=boneMatX*skinVertex*skinWeight.x;
skinned +=boneMatY*skinVertex*skinWeight.y;
skinned +=boneMatZ*skinVertex*skinWeight.z;
skinned +=boneMatW*skinVertex*skinWeight.w;
transformed=(bindMatrixInverse*skinned).xyz;
#endif`,Eg=`#ifdef USE_SKINNING
mat4 skinMatrix=mat4(0.0);
skinMatrix +=skinWeight.x*boneMatX;
skinMatrix +=skinWeight.y*boneMatY;
skinMatrix +=skinWeight.z*boneMatZ;
skinMatrix +=skinWeight.w*boneMatW;
skinMatrix=bindMatrixInverse*skinMatrix*bindMatrix;
objectNormal=vec4(skinMatrix*vec4(objectNormal,0.0)).xyz;
#ifdef USE_TANGENT
objectTangent=vec4(skinMatrix*vec4(objectTangent,0.0)).xyz;
#endif
#endif`,Ag=`float specularStrength;
#ifdef USE_SPECULARMAP
vec4 texelSpecular=texture2D(specularMap,vSpecularMapUv);
specularStrength=texelSpecular.r;
#else
specularStrength=1.0;
#endif`,Tg=`#ifdef USE_SPECULARMAP
uniform sampler2D specularMap;
#endif`,Rg=`#if defined( TONE_MAPPING )
gl_FragColor.rgb=toneMapping(gl_FragColor.rgb);
#endif`,Cg=`#ifndef saturate
#define saturate( a ) clamp( a, 0.0, 1.0 )
#endif
uniform float toneMappingExposure;
vec3 LinearToneMapping(vec3 color){
return saturate(toneMappingExposure*color);
}
vec3 ReinhardToneMapping(vec3 color){
color*=toneMappingExposure;
return saturate(color /(vec3(1.0)+ color));
}
vec3 CineonToneMapping(vec3 color){
color*=toneMappingExposure;
color=max(vec3(0.0),color - 0.004);
return pow((color*(6.2*color + 0.5))/(color*(6.2*color + 1.7)+ 0.06),vec3(2.2));
}
vec3 RRTAndODTFit(vec3 v){
vec3 a=v*(v + 0.0245786)- 0.000090537;
vec3 b=v*(0.983729*v + 0.4329510)+ 0.238081;
return a / b;
}
vec3 ACESFilmicToneMapping(vec3 color){
const mat3 ACESInputMat=mat3(
vec3(0.59719,0.07600,0.02840),vec3(0.35458,0.90834,0.13383),
vec3(0.04823,0.01566,0.83777)
);
const mat3 ACESOutputMat=mat3(
vec3(1.60475,-0.10208,-0.00327),vec3(-0.53108,1.10813,-0.07276),
vec3(-0.07367,-0.00605,1.07602)
);
color*=toneMappingExposure / 0.6;
color=ACESInputMat*color;
color=RRTAndODTFit(color);
color=ACESOutputMat*color;
return saturate(color);
}
const mat3 LINEAR_REC2020_TO_LINEAR_SRGB=mat3(
vec3(1.6605,- 0.1246,- 0.0182),
vec3(- 0.5876,1.1329,- 0.1006),
vec3(- 0.0728,- 0.0083,1.1187)
);
const mat3 LINEAR_SRGB_TO_LINEAR_REC2020=mat3(
vec3(0.6274,0.0691,0.0164),
vec3(0.3293,0.9195,0.0880),
vec3(0.0433,0.0113,0.8956)
);
vec3 agxDefaultContrastApprox(vec3 x){
vec3 x2=x*x;
vec3 x4=x2*x2;
return + 15.5*x4*x2
- 40.14*x4*x
+ 31.96*x4
- 6.868*x2*x
+ 0.4298*x2
+ 0.1191*x
- 0.00232;
}
vec3 AgXToneMapping(vec3 color){
const mat3 AgXInsetMatrix=mat3(
vec3(0.856627153315983,0.137318972929847,0.11189821299995),
vec3(0.0951212405381588,0.761241990602591,0.0767994186031903),
vec3(0.0482516061458583,0.101439036467562,0.811302368396859)
);
const mat3 AgXOutsetMatrix=mat3(
vec3(1.1271005818144368,- 0.1413297634984383,- 0.14132976349843826),
vec3(- 0.11060664309660323,1.157823702216272,- 0.11060664309660294),
vec3(- 0.016493938717834573,- 0.016493938717834257,1.2519364065950405)
);
const float AgxMinEv=- 12.47393;const float AgxMaxEv=4.026069;
color*=toneMappingExposure;
color=LINEAR_SRGB_TO_LINEAR_REC2020*color;
color=AgXInsetMatrix*color;
color=max(color,1e-10);color=log2(color);
color=(color - AgxMinEv)/(AgxMaxEv - AgxMinEv);
color=clamp(color,0.0,1.0);
color=agxDefaultContrastApprox(color);
color=AgXOutsetMatrix*color;
color=pow(max(vec3(0.0),color),vec3(2.2));
color=LINEAR_REC2020_TO_LINEAR_SRGB*color;
color=clamp(color,0.0,1.0);
return color;
}
vec3 NeutralToneMapping(vec3 color){
const float StartCompression=0.8 - 0.04;
const float Desaturation=0.15;
color*=toneMappingExposure;
float x=min(color.r,min(color.g,color.b));
float offset=x<0.08?x - 6.25*x*x:0.04;
color -=offset;
float peak=max(color.r,max(color.g,color.b));
if(peak<StartCompression)return color;
float d=1. - StartCompression;
float newPeak=1. - d*d /(peak + d - StartCompression);
color*=newPeak / peak;
float g=1. - 1. /(Desaturation*(peak - newPeak)+ 1.);
return mix(color,vec3(newPeak),g);
}
vec3 CustomToneMapping(vec3 color){return color;}`,Pg=`#ifdef USE_TRANSMISSION
material.transmission=transmission;
material.transmissionAlpha=1.0;
material.thickness=thickness;
material.attenuationDistance=attenuationDistance;
material.attenuationColor=attenuationColor;
#ifdef USE_TRANSMISSIONMAP
material.transmission*=texture2D(transmissionMap,vTransmissionMapUv).r;
#endif
#ifdef USE_THICKNESSMAP
material.thickness*=texture2D(thicknessMap,vThicknessMapUv).g;
#endif
vec3 pos=vWorldPosition;
vec3 v=normalize(cameraPosition - pos);
vec3 n=transformNormalByInverseViewMatrix(normal,viewMatrix);
vec4 transmitted=getIBLVolumeRefraction(
n,v,material.roughness,material.diffuseContribution,material.specularColorBlended,material.specularF90,
pos,modelMatrix,viewMatrix,projectionMatrix,material.dispersion,material.ior,material.thickness,
material.attenuationColor,material.attenuationDistance);
material.transmissionAlpha=mix(material.transmissionAlpha,transmitted.a,material.transmission);
totalDiffuse=mix(totalDiffuse,transmitted.rgb,material.transmission);
#endif`,Ig=`#ifdef USE_TRANSMISSION
uniform float transmission;
uniform float thickness;
uniform float attenuationDistance;
uniform vec3 attenuationColor;
#ifdef USE_TRANSMISSIONMAP
uniform sampler2D transmissionMap;
#endif
#ifdef USE_THICKNESSMAP
uniform sampler2D thicknessMap;
#endif
uniform vec2 transmissionSamplerSize;
uniform sampler2D transmissionSamplerMap;
uniform mat4 modelMatrix;
uniform mat4 projectionMatrix;
varying vec3 vWorldPosition;
float w0(float a){
return(1.0 / 6.0)*(a*(a*(- a + 3.0)- 3.0)+ 1.0);
}
float w1(float a){
return(1.0 / 6.0)*(a*a*(3.0*a - 6.0)+ 4.0);
}
float w2(float a){
return(1.0 / 6.0)*(a*(a*(- 3.0*a + 3.0)+ 3.0)+ 1.0);
}
float w3(float a){
return(1.0 / 6.0)*(a*a*a);
}
float g0(float a){
return w0(a)+ w1(a);
}
float g1(float a){
return w2(a)+ w3(a);
}
float h0(float a){
return - 1.0 + w1(a)/(w0(a)+ w1(a));
}
float h1(float a){
return 1.0 + w3(a)/(w2(a)+ w3(a));
}
vec4 bicubic(sampler2D tex,vec2 uv,vec4 texelSize,float lod){
uv=uv*texelSize.zw + 0.5;
vec2 iuv=floor(uv);
vec2 fuv=fract(uv);
float g0x=g0(fuv.x);
float g1x=g1(fuv.x);
float h0x=h0(fuv.x);
float h1x=h1(fuv.x);
float h0y=h0(fuv.y);
float h1y=h1(fuv.y);
vec2 p0=(vec2(iuv.x + h0x,iuv.y + h0y)- 0.5)*texelSize.xy;
vec2 p1=(vec2(iuv.x + h1x,iuv.y + h0y)- 0.5)*texelSize.xy;
vec2 p2=(vec2(iuv.x + h0x,iuv.y + h1y)- 0.5)*texelSize.xy;
vec2 p3=(vec2(iuv.x + h1x,iuv.y + h1y)- 0.5)*texelSize.xy;
return g0(fuv.y)*(g0x*textureLod(tex,p0,lod)+ g1x*textureLod(tex,p1,lod))+
g1(fuv.y)*(g0x*textureLod(tex,p2,lod)+ g1x*textureLod(tex,p3,lod));
}
vec4 textureBicubic(sampler2D sampler,vec2 uv,float lod){
vec2 fLodSize=vec2(textureSize(sampler,int(lod)));
vec2 cLodSize=vec2(textureSize(sampler,int(lod + 1.0)));
vec2 fLodSizeInv=1.0 / fLodSize;
vec2 cLodSizeInv=1.0 / cLodSize;
vec4 fSample=bicubic(sampler,uv,vec4(fLodSizeInv,fLodSize),floor(lod));
vec4 cSample=bicubic(sampler,uv,vec4(cLodSizeInv,cLodSize),ceil(lod));
return mix(fSample,cSample,fract(lod));
}
vec3 getVolumeTransmissionRay(const in vec3 n,const in vec3 v,const in float thickness,const in float ior,const in mat4 modelMatrix){
vec3 refractionVector=refract(- v,normalize(n),1.0 / ior);
vec3 modelScale;
modelScale.x=length(vec3(modelMatrix[ 0 ].xyz));
modelScale.y=length(vec3(modelMatrix[ 1 ].xyz));
modelScale.z=length(vec3(modelMatrix[ 2 ].xyz));
return normalize(refractionVector)*thickness*modelScale;
}
float applyIorToRoughness(const in float roughness,const in float ior){
return roughness*clamp(ior*2.0 - 2.0,0.0,1.0);
}
vec4 getTransmissionSample(const in vec2 fragCoord,const in float roughness,const in float ior){
float lod=log2(transmissionSamplerSize.x)*applyIorToRoughness(roughness,ior);
return textureBicubic(transmissionSamplerMap,fragCoord.xy,lod);
}
vec3 volumeAttenuation(const in float transmissionDistance,const in vec3 attenuationColor,const in float attenuationDistance){
if(isinf(attenuationDistance)){
return vec3(1.0);
}else{
vec3 attenuationCoefficient=-log(attenuationColor)/ attenuationDistance;
vec3 transmittance=exp(- attenuationCoefficient*transmissionDistance);return transmittance;
}
}
vec4 getIBLVolumeRefraction(const in vec3 n,const in vec3 v,const in float roughness,const in vec3 diffuseColor,
const in vec3 specularColor,const in float specularF90,const in vec3 position,const in mat4 modelMatrix,
const in mat4 viewMatrix,const in mat4 projMatrix,const in float dispersion,const in float ior,const in float thickness,
const in vec3 attenuationColor,const in float attenuationDistance){
vec4 transmittedLight;
vec3 transmittance;
#ifdef USE_DISPERSION
float halfSpread=(ior - 1.0)*0.025*dispersion;
vec3 iors=vec3(ior - halfSpread,ior,ior + halfSpread);
for(int i=0;i<3;i ++){
vec3 transmissionRay=getVolumeTransmissionRay(n,v,thickness,iors[ i ],modelMatrix);
vec3 refractedRayExit=position + transmissionRay;
vec4 ndcPos=projMatrix*viewMatrix*vec4(refractedRayExit,1.0);
vec2 refractionCoords=ndcPos.xy / ndcPos.w;
refractionCoords +=1.0;
refractionCoords /=2.0;
vec4 transmissionSample=getTransmissionSample(refractionCoords,roughness,iors[ i ]);
transmittedLight[ i ]=transmissionSample[ i ];
transmittedLight.a +=transmissionSample.a;
transmittance[ i ]=diffuseColor[ i ]*volumeAttenuation(length(transmissionRay),attenuationColor,attenuationDistance)[ i ];
}
transmittedLight.a /=3.0;
#else
vec3 transmissionRay=getVolumeTransmissionRay(n,v,thickness,ior,modelMatrix);
vec3 refractedRayExit=position + transmissionRay;
vec4 ndcPos=projMatrix*viewMatrix*vec4(refractedRayExit,1.0);
vec2 refractionCoords=ndcPos.xy / ndcPos.w;
refractionCoords +=1.0;
refractionCoords /=2.0;
transmittedLight=getTransmissionSample(refractionCoords,roughness,ior);
transmittance=diffuseColor*volumeAttenuation(length(transmissionRay),attenuationColor,attenuationDistance);
#endif
vec3 attenuatedColor=transmittance*transmittedLight.rgb;
vec3 F=EnvironmentBRDF(n,v,specularColor,specularF90,roughness);
float transmittanceFactor=(transmittance.r + transmittance.g + transmittance.b)/ 3.0;
return vec4((1.0 - F)*attenuatedColor,1.0 -(1.0 - transmittedLight.a)*transmittanceFactor);
}
#endif`,Lg=`#if defined( USE_UV ) || defined( USE_ANISOTROPY )
varying vec2 vUv;
#endif
#ifdef USE_MAP
varying vec2 vMapUv;
#endif
#ifdef USE_ALPHAMAP
varying vec2 vAlphaMapUv;
#endif
#ifdef USE_LIGHTMAP
varying vec2 vLightMapUv;
#endif
#ifdef USE_AOMAP
varying vec2 vAoMapUv;
#endif
#ifdef USE_BUMPMAP
varying vec2 vBumpMapUv;
#endif
#ifdef USE_NORMALMAP
varying vec2 vNormalMapUv;
#endif
#ifdef USE_EMISSIVEMAP
varying vec2 vEmissiveMapUv;
#endif
#ifdef USE_METALNESSMAP
varying vec2 vMetalnessMapUv;
#endif
#ifdef USE_ROUGHNESSMAP
varying vec2 vRoughnessMapUv;
#endif
#ifdef USE_DIFFUSE_ROUGHNESSMAP
varying vec2 vDiffuseRoughnessMapUv;
#endif
#ifdef USE_ANISOTROPYMAP
varying vec2 vAnisotropyMapUv;
#endif
#ifdef USE_CLEARCOATMAP
varying vec2 vClearcoatMapUv;
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
varying vec2 vClearcoatNormalMapUv;
#endif
#ifdef USE_CLEARCOAT_ROUGHNESSMAP
varying vec2 vClearcoatRoughnessMapUv;
#endif
#ifdef USE_IRIDESCENCEMAP
varying vec2 vIridescenceMapUv;
#endif
#ifdef USE_IRIDESCENCE_THICKNESSMAP
varying vec2 vIridescenceThicknessMapUv;
#endif
#ifdef USE_SHEEN_COLORMAP
varying vec2 vSheenColorMapUv;
#endif
#ifdef USE_SHEEN_ROUGHNESSMAP
varying vec2 vSheenRoughnessMapUv;
#endif
#ifdef USE_SPECULARMAP
varying vec2 vSpecularMapUv;
#endif
#ifdef USE_SPECULAR_COLORMAP
varying vec2 vSpecularColorMapUv;
#endif
#ifdef USE_SPECULAR_INTENSITYMAP
varying vec2 vSpecularIntensityMapUv;
#endif
#ifdef USE_TRANSMISSIONMAP
uniform mat3 transmissionMapTransform;
varying vec2 vTransmissionMapUv;
#endif
#ifdef USE_THICKNESSMAP
uniform mat3 thicknessMapTransform;
varying vec2 vThicknessMapUv;
#endif`,Ng=`#if defined( USE_UV ) || defined( USE_ANISOTROPY )
varying vec2 vUv;
#endif
#ifdef USE_MAP
uniform mat3 mapTransform;
varying vec2 vMapUv;
#endif
#ifdef USE_ALPHAMAP
uniform mat3 alphaMapTransform;
varying vec2 vAlphaMapUv;
#endif
#ifdef USE_LIGHTMAP
uniform mat3 lightMapTransform;
varying vec2 vLightMapUv;
#endif
#ifdef USE_AOMAP
uniform mat3 aoMapTransform;
varying vec2 vAoMapUv;
#endif
#ifdef USE_BUMPMAP
uniform mat3 bumpMapTransform;
varying vec2 vBumpMapUv;
#endif
#ifdef USE_NORMALMAP
uniform mat3 normalMapTransform;
varying vec2 vNormalMapUv;
#endif
#ifdef USE_DISPLACEMENTMAP
uniform mat3 displacementMapTransform;
varying vec2 vDisplacementMapUv;
#endif
#ifdef USE_EMISSIVEMAP
uniform mat3 emissiveMapTransform;
varying vec2 vEmissiveMapUv;
#endif
#ifdef USE_METALNESSMAP
uniform mat3 metalnessMapTransform;
varying vec2 vMetalnessMapUv;
#endif
#ifdef USE_ROUGHNESSMAP
uniform mat3 roughnessMapTransform;
varying vec2 vRoughnessMapUv;
#endif
#ifdef USE_DIFFUSE_ROUGHNESSMAP
uniform mat3 diffuseRoughnessMapTransform;
varying vec2 vDiffuseRoughnessMapUv;
#endif
#ifdef USE_ANISOTROPYMAP
uniform mat3 anisotropyMapTransform;
varying vec2 vAnisotropyMapUv;
#endif
#ifdef USE_CLEARCOATMAP
uniform mat3 clearcoatMapTransform;
varying vec2 vClearcoatMapUv;
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
uniform mat3 clearcoatNormalMapTransform;
varying vec2 vClearcoatNormalMapUv;
#endif
#ifdef USE_CLEARCOAT_ROUGHNESSMAP
uniform mat3 clearcoatRoughnessMapTransform;
varying vec2 vClearcoatRoughnessMapUv;
#endif
#ifdef USE_SHEEN_COLORMAP
uniform mat3 sheenColorMapTransform;
varying vec2 vSheenColorMapUv;
#endif
#ifdef USE_SHEEN_ROUGHNESSMAP
uniform mat3 sheenRoughnessMapTransform;
varying vec2 vSheenRoughnessMapUv;
#endif
#ifdef USE_IRIDESCENCEMAP
uniform mat3 iridescenceMapTransform;
varying vec2 vIridescenceMapUv;
#endif
#ifdef USE_IRIDESCENCE_THICKNESSMAP
uniform mat3 iridescenceThicknessMapTransform;
varying vec2 vIridescenceThicknessMapUv;
#endif
#ifdef USE_SPECULARMAP
uniform mat3 specularMapTransform;
varying vec2 vSpecularMapUv;
#endif
#ifdef USE_SPECULAR_COLORMAP
uniform mat3 specularColorMapTransform;
varying vec2 vSpecularColorMapUv;
#endif
#ifdef USE_SPECULAR_INTENSITYMAP
uniform mat3 specularIntensityMapTransform;
varying vec2 vSpecularIntensityMapUv;
#endif
#ifdef USE_TRANSMISSIONMAP
uniform mat3 transmissionMapTransform;
varying vec2 vTransmissionMapUv;
#endif
#ifdef USE_THICKNESSMAP
uniform mat3 thicknessMapTransform;
varying vec2 vThicknessMapUv;
#endif`,Dg=`#if defined( USE_UV ) || defined( USE_ANISOTROPY )
vUv=vec3(uv,1).xy;
#endif
#ifdef USE_MAP
vMapUv=(mapTransform*vec3(MAP_UV,1)).xy;
#endif
#ifdef USE_ALPHAMAP
vAlphaMapUv=(alphaMapTransform*vec3(ALPHAMAP_UV,1)).xy;
#endif
#ifdef USE_LIGHTMAP
vLightMapUv=(lightMapTransform*vec3(LIGHTMAP_UV,1)).xy;
#endif
#ifdef USE_AOMAP
vAoMapUv=(aoMapTransform*vec3(AOMAP_UV,1)).xy;
#endif
#ifdef USE_BUMPMAP
vBumpMapUv=(bumpMapTransform*vec3(BUMPMAP_UV,1)).xy;
#endif
#ifdef USE_NORMALMAP
vNormalMapUv=(normalMapTransform*vec3(NORMALMAP_UV,1)).xy;
#endif
#ifdef USE_DISPLACEMENTMAP
vDisplacementMapUv=(displacementMapTransform*vec3(DISPLACEMENTMAP_UV,1)).xy;
#endif
#ifdef USE_EMISSIVEMAP
vEmissiveMapUv=(emissiveMapTransform*vec3(EMISSIVEMAP_UV,1)).xy;
#endif
#ifdef USE_METALNESSMAP
vMetalnessMapUv=(metalnessMapTransform*vec3(METALNESSMAP_UV,1)).xy;
#endif
#ifdef USE_ROUGHNESSMAP
vRoughnessMapUv=(roughnessMapTransform*vec3(ROUGHNESSMAP_UV,1)).xy;
#endif
#ifdef USE_DIFFUSE_ROUGHNESSMAP
vDiffuseRoughnessMapUv=(diffuseRoughnessMapTransform*vec3(DIFFUSE_ROUGHNESSMAP_UV,1)).xy;
#endif
#ifdef USE_ANISOTROPYMAP
vAnisotropyMapUv=(anisotropyMapTransform*vec3(ANISOTROPYMAP_UV,1)).xy;
#endif
#ifdef USE_CLEARCOATMAP
vClearcoatMapUv=(clearcoatMapTransform*vec3(CLEARCOATMAP_UV,1)).xy;
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
vClearcoatNormalMapUv=(clearcoatNormalMapTransform*vec3(CLEARCOAT_NORMALMAP_UV,1)).xy;
#endif
#ifdef USE_CLEARCOAT_ROUGHNESSMAP
vClearcoatRoughnessMapUv=(clearcoatRoughnessMapTransform*vec3(CLEARCOAT_ROUGHNESSMAP_UV,1)).xy;
#endif
#ifdef USE_IRIDESCENCEMAP
vIridescenceMapUv=(iridescenceMapTransform*vec3(IRIDESCENCEMAP_UV,1)).xy;
#endif
#ifdef USE_IRIDESCENCE_THICKNESSMAP
vIridescenceThicknessMapUv=(iridescenceThicknessMapTransform*vec3(IRIDESCENCE_THICKNESSMAP_UV,1)).xy;
#endif
#ifdef USE_SHEEN_COLORMAP
vSheenColorMapUv=(sheenColorMapTransform*vec3(SHEEN_COLORMAP_UV,1)).xy;
#endif
#ifdef USE_SHEEN_ROUGHNESSMAP
vSheenRoughnessMapUv=(sheenRoughnessMapTransform*vec3(SHEEN_ROUGHNESSMAP_UV,1)).xy;
#endif
#ifdef USE_SPECULARMAP
vSpecularMapUv=(specularMapTransform*vec3(SPECULARMAP_UV,1)).xy;
#endif
#ifdef USE_SPECULAR_COLORMAP
vSpecularColorMapUv=(specularColorMapTransform*vec3(SPECULAR_COLORMAP_UV,1)).xy;
#endif
#ifdef USE_SPECULAR_INTENSITYMAP
vSpecularIntensityMapUv=(specularIntensityMapTransform*vec3(SPECULAR_INTENSITYMAP_UV,1)).xy;
#endif
#ifdef USE_TRANSMISSIONMAP
vTransmissionMapUv=(transmissionMapTransform*vec3(TRANSMISSIONMAP_UV,1)).xy;
#endif
#ifdef USE_THICKNESSMAP
vThicknessMapUv=(thicknessMapTransform*vec3(THICKNESSMAP_UV,1)).xy;
#endif`,Fg=`#if defined( USE_ENVMAP ) || defined( DISTANCE ) || defined ( USE_SHADOWMAP ) || defined ( USE_TRANSMISSION ) || NUM_SPOT_LIGHT_COORDS > 0
vec4 worldPosition=vec4(transformed,1.0);
#ifdef USE_BATCHING
worldPosition=batchingMatrix*worldPosition;
#endif
#ifdef USE_INSTANCING
worldPosition=instanceMatrix*worldPosition;
#endif
worldPosition=modelMatrix*worldPosition;
#endif`,Ug=`varying vec2 vUv;
uniform mat3 uvTransform;
void main(){
vUv=(uvTransform*vec3(uv,1)).xy;
gl_Position=vec4(position.xy,1.0,1.0);
}`,Og=`uniform sampler2D t2D;
uniform float backgroundIntensity;
varying vec2 vUv;
void main(){
vec4 texColor=texture2D(t2D,vUv);
#ifdef DECODE_VIDEO_TEXTURE
texColor=vec4(mix(pow(texColor.rgb*0.9478672986 + vec3(0.0521327014),vec3(2.4)),texColor.rgb*0.0773993808,vec3(lessThanEqual(texColor.rgb,vec3(0.04045)))),texColor.w);
#endif
texColor.rgb*=backgroundIntensity;
gl_FragColor=texColor;
#include <tonemapping_fragment>
#include <colorspace_fragment>
}`,Bg=`varying vec3 vWorldDirection;
#include <common>
void main(){
vWorldDirection=transformDirection(position,modelMatrix);
#include <begin_vertex>
#include <project_vertex>
gl_Position.z=gl_Position.w;
}`,kg=`uniform float backgroundBlurriness;
uniform float backgroundIntensity;
uniform mat3 backgroundRotation;
varying vec3 vWorldDirection;
#include <envmap_common_pars_fragment>
void main(){
#ifdef ENVMAP_TYPE_PMREM
vec4 texColor=textureLod(envMap,backgroundRotation*vWorldDirection,roughnessToMip(backgroundBlurriness));
#else
vec4 texColor=textureCube(envMap,backgroundRotation*vWorldDirection);
#endif
texColor.rgb*=backgroundIntensity;
gl_FragColor=texColor;
#include <tonemapping_fragment>
#include <colorspace_fragment>
}`,zg=`varying vec3 vWorldDirection;
#include <common>
void main(){
vWorldDirection=transformDirection(position,modelMatrix);
#include <begin_vertex>
#include <project_vertex>
gl_Position.z=gl_Position.w;
}`,Vg=`uniform samplerCube tCube;
uniform float tFlip;
uniform float opacity;
varying vec3 vWorldDirection;
void main(){
vec4 texColor=textureCube(tCube,vec3(tFlip*vWorldDirection.x,vWorldDirection.yz));
gl_FragColor=texColor;
gl_FragColor.a*=opacity;
#include <tonemapping_fragment>
#include <colorspace_fragment>
}`,Gg=`#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
varying vec2 vHighPrecisionZW;
void main(){
#include <uv_vertex>
#include <batching_vertex>
#include <skinbase_vertex>
#include <morphinstance_vertex>
#ifdef USE_DISPLACEMENTMAP
#include <beginnormal_vertex>
#include <morphnormal_vertex>
#include <skinnormal_vertex>
#endif
#include <begin_vertex>
#include <morphtarget_vertex>
#include <skinning_vertex>
#include <displacementmap_vertex>
#include <project_vertex>
#include <logdepthbuf_vertex>
#include <clipping_planes_vertex>
vHighPrecisionZW=gl_Position.zw;
}`,Hg=`#if DEPTH_PACKING == 3200
uniform float opacity;
#endif
#include <common>
#include <packing>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
varying vec2 vHighPrecisionZW;
void main(){
vec4 diffuseColor=vec4(1.0);
#include <clipping_planes_fragment>
#if DEPTH_PACKING == 3200
diffuseColor.a=opacity;
#endif
#include <map_fragment>
#include <alphamap_fragment>
#include <alphatest_fragment>
#include <alphahash_fragment>
#include <logdepthbuf_fragment>
#ifdef USE_REVERSED_DEPTH_BUFFER
float fragCoordZ=vHighPrecisionZW[ 0 ] / vHighPrecisionZW[ 1 ];
#else
float fragCoordZ=0.5*vHighPrecisionZW[ 0 ] / vHighPrecisionZW[ 1 ] + 0.5;
#endif
#if DEPTH_PACKING == 3200
gl_FragColor=vec4(vec3(1.0 - fragCoordZ),opacity);
#elif DEPTH_PACKING == 3201
gl_FragColor=packDepthToRGBA(fragCoordZ);
#elif DEPTH_PACKING == 3202
gl_FragColor=vec4(packDepthToRGB(fragCoordZ),1.0);
#elif DEPTH_PACKING == 3203
gl_FragColor=vec4(packDepthToRG(fragCoordZ),0.0,1.0);
#endif
}`,Wg=`#define DISTANCE
varying vec3 vWorldPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <clipping_planes_pars_vertex>
void main(){
#include <uv_vertex>
#include <batching_vertex>
#include <skinbase_vertex>
#include <morphinstance_vertex>
#ifdef USE_DISPLACEMENTMAP
#include <beginnormal_vertex>
#include <morphnormal_vertex>
#include <skinnormal_vertex>
#endif
#include <begin_vertex>
#include <morphtarget_vertex>
#include <skinning_vertex>
#include <displacementmap_vertex>
#include <project_vertex>
#include <worldpos_vertex>
#include <clipping_planes_vertex>
vWorldPosition=worldPosition.xyz;
}`,Xg=`#define DISTANCE
uniform vec3 referencePosition;
uniform float nearDistance;
uniform float farDistance;
varying vec3 vWorldPosition;
#include <common>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <clipping_planes_pars_fragment>
void main(){
vec4 diffuseColor=vec4(1.0);
#include <clipping_planes_fragment>
#include <map_fragment>
#include <alphamap_fragment>
#include <alphatest_fragment>
#include <alphahash_fragment>
float dist=length(vWorldPosition - referencePosition);
dist=(dist - nearDistance)/(farDistance - nearDistance);
dist=saturate(dist);
gl_FragColor=vec4(dist,0.0,0.0,1.0);
}`,qg=`varying vec3 vWorldDirection;
#include <common>
void main(){
vWorldDirection=transformDirection(position,modelMatrix);
#include <begin_vertex>
#include <project_vertex>
}`,Yg=`uniform sampler2D tEquirect;
varying vec3 vWorldDirection;
#include <common>
void main(){
vec3 direction=normalize(vWorldDirection);
vec2 sampleUV=equirectUv(direction);
gl_FragColor=texture2D(tEquirect,sampleUV);
#include <tonemapping_fragment>
#include <colorspace_fragment>
}`,$g=`uniform float scale;
attribute float lineDistance;
varying float vLineDistance;
#include <common>
#include <uv_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <morphtarget_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main(){
vLineDistance=scale*lineDistance;
#include <uv_vertex>
#include <color_vertex>
#include <morphinstance_vertex>
#include <morphcolor_vertex>
#include <begin_vertex>
#include <morphtarget_vertex>
#include <project_vertex>
#include <logdepthbuf_vertex>
#include <clipping_planes_vertex>
#include <fog_vertex>
}`,Zg=`uniform vec3 diffuse;
uniform float opacity;
uniform float dashSize;
uniform float totalSize;
varying float vLineDistance;
#include <common>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <fog_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main(){
vec4 diffuseColor=vec4(diffuse,opacity);
#include <clipping_planes_fragment>
if(mod(vLineDistance,totalSize)>dashSize){
discard;
}
vec3 outgoingLight=vec3(0.0);
#include <logdepthbuf_fragment>
#include <map_fragment>
#include <color_fragment>
outgoingLight=diffuseColor.rgb;
#include <opaque_fragment>
#include <tonemapping_fragment>
#include <colorspace_fragment>
#include <fog_fragment>
#include <premultiplied_alpha_fragment>
}`,Jg=`#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <envmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main(){
#include <uv_vertex>
#include <color_vertex>
#include <morphinstance_vertex>
#include <morphcolor_vertex>
#include <batching_vertex>
#if defined ( USE_ENVMAP ) || defined ( USE_SKINNING )
#include <beginnormal_vertex>
#include <morphnormal_vertex>
#include <skinbase_vertex>
#include <skinnormal_vertex>
#include <defaultnormal_vertex>
#endif
#include <begin_vertex>
#include <morphtarget_vertex>
#include <skinning_vertex>
#include <project_vertex>
#include <logdepthbuf_vertex>
#include <clipping_planes_vertex>
#include <worldpos_vertex>
#include <envmap_vertex>
#include <fog_vertex>
}`,Kg=`uniform vec3 diffuse;
uniform float opacity;
#ifndef FLAT_SHADED
varying vec3 vNormal;
#endif
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <envmap_common_pars_fragment>
#include <envmap_pars_fragment>
#include <fog_pars_fragment>
#include <specularmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main(){
vec4 diffuseColor=vec4(diffuse,opacity);
#include <clipping_planes_fragment>
#include <logdepthbuf_fragment>
#include <map_fragment>
#include <color_fragment>
#include <alphamap_fragment>
#include <alphatest_fragment>
#include <alphahash_fragment>
#include <specularmap_fragment>
ReflectedLight reflectedLight=ReflectedLight(vec3(0.0),vec3(0.0),vec3(0.0),vec3(0.0));
#ifdef USE_LIGHTMAP
vec4 lightMapTexel=texture2D(lightMap,vLightMapUv);
reflectedLight.indirectDiffuse +=lightMapTexel.rgb*lightMapIntensity*RECIPROCAL_PI;
#else
reflectedLight.indirectDiffuse +=vec3(1.0);
#endif
#include <aomap_fragment>
reflectedLight.indirectDiffuse*=diffuseColor.rgb;
vec3 outgoingLight=reflectedLight.indirectDiffuse;
#include <envmap_fragment>
#include <opaque_fragment>
#include <tonemapping_fragment>
#include <colorspace_fragment>
#include <fog_fragment>
#include <premultiplied_alpha_fragment>
#include <dithering_fragment>
}`,jg=`#define LAMBERT
varying vec3 vViewPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <envmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <shadowmap_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main(){
#include <uv_vertex>
#include <color_vertex>
#include <morphinstance_vertex>
#include <morphcolor_vertex>
#include <batching_vertex>
#include <beginnormal_vertex>
#include <morphnormal_vertex>
#include <skinbase_vertex>
#include <skinnormal_vertex>
#include <defaultnormal_vertex>
#include <normal_vertex>
#include <begin_vertex>
#include <morphtarget_vertex>
#include <skinning_vertex>
#include <displacementmap_vertex>
#include <project_vertex>
#include <logdepthbuf_vertex>
#include <clipping_planes_vertex>
vViewPosition=- mvPosition.xyz;
#include <worldpos_vertex>
#include <envmap_vertex>
#include <shadowmap_vertex>
#include <fog_vertex>
}`,Qg=`#define LAMBERT
uniform vec3 diffuse;
uniform vec3 emissive;
uniform float opacity;
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <emissivemap_pars_fragment>
#include <envmap_common_pars_fragment>
#include <envmap_pars_fragment>
#include <envmap_physical_pars_fragment>
#include <fog_pars_fragment>
#include <bsdfs>
#include <lights_pars_begin>
#include <normal_pars_fragment>
#include <lights_lambert_pars_fragment>
#include <shadowmap_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <specularmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main(){
vec4 diffuseColor=vec4(diffuse,opacity);
#include <clipping_planes_fragment>
ReflectedLight reflectedLight=ReflectedLight(vec3(0.0),vec3(0.0),vec3(0.0),vec3(0.0));
vec3 totalEmissiveRadiance=emissive;
#include <logdepthbuf_fragment>
#include <map_fragment>
#include <color_fragment>
#include <alphamap_fragment>
#include <alphatest_fragment>
#include <alphahash_fragment>
#include <specularmap_fragment>
#include <normal_fragment_begin>
#include <normal_fragment_maps>
#include <emissivemap_fragment>
#include <lights_lambert_fragment>
#include <lights_fragment_begin>
#include <lights_fragment_maps>
#include <lights_fragment_end>
#include <aomap_fragment>
vec3 outgoingLight=reflectedLight.directDiffuse + reflectedLight.indirectDiffuse + totalEmissiveRadiance;
#include <envmap_fragment>
#include <opaque_fragment>
#include <tonemapping_fragment>
#include <colorspace_fragment>
#include <fog_fragment>
#include <premultiplied_alpha_fragment>
#include <dithering_fragment>
}`,e0=`#define MATCAP
varying vec3 vViewPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <color_pars_vertex>
#include <displacementmap_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main(){
#include <uv_vertex>
#include <color_vertex>
#include <morphinstance_vertex>
#include <morphcolor_vertex>
#include <batching_vertex>
#include <beginnormal_vertex>
#include <morphnormal_vertex>
#include <skinbase_vertex>
#include <skinnormal_vertex>
#include <defaultnormal_vertex>
#include <normal_vertex>
#include <begin_vertex>
#include <morphtarget_vertex>
#include <skinning_vertex>
#include <displacementmap_vertex>
#include <project_vertex>
#include <logdepthbuf_vertex>
#include <clipping_planes_vertex>
#include <fog_vertex>
vViewPosition=- mvPosition.xyz;
}`,t0=`#define MATCAP
uniform vec3 diffuse;
uniform float opacity;
uniform sampler2D matcap;
varying vec3 vViewPosition;
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <fog_pars_fragment>
#include <normal_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main(){
vec4 diffuseColor=vec4(diffuse,opacity);
#include <clipping_planes_fragment>
#include <logdepthbuf_fragment>
#include <map_fragment>
#include <color_fragment>
#include <alphamap_fragment>
#include <alphatest_fragment>
#include <alphahash_fragment>
#include <normal_fragment_begin>
#include <normal_fragment_maps>
vec3 viewDir=normalize(vViewPosition);
vec3 x=normalize(vec3(viewDir.z,0.0,- viewDir.x));
vec3 y=cross(viewDir,x);
vec2 uv=vec2(dot(x,normal),dot(y,normal))*0.495 + 0.5;
#ifdef USE_MATCAP
vec4 matcapColor=texture2D(matcap,uv);
#else
vec4 matcapColor=vec4(vec3(mix(0.2,0.8,uv.y)),1.0);
#endif
vec3 outgoingLight=diffuseColor.rgb*matcapColor.rgb;
#include <opaque_fragment>
#include <tonemapping_fragment>
#include <colorspace_fragment>
#include <fog_fragment>
#include <premultiplied_alpha_fragment>
#include <dithering_fragment>
}`,n0=`#define NORMAL
#if defined( FLAT_SHADED ) || defined( USE_BUMPMAP ) || defined( USE_NORMALMAP_TANGENTSPACE )
varying vec3 vViewPosition;
#endif
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main(){
#include <uv_vertex>
#include <batching_vertex>
#include <beginnormal_vertex>
#include <morphinstance_vertex>
#include <morphnormal_vertex>
#include <skinbase_vertex>
#include <skinnormal_vertex>
#include <defaultnormal_vertex>
#include <normal_vertex>
#include <begin_vertex>
#include <morphtarget_vertex>
#include <skinning_vertex>
#include <displacementmap_vertex>
#include <project_vertex>
#include <logdepthbuf_vertex>
#include <clipping_planes_vertex>
#if defined( FLAT_SHADED ) || defined( USE_BUMPMAP ) || defined( USE_NORMALMAP_TANGENTSPACE )
vViewPosition=- mvPosition.xyz;
#endif
}`,i0=`#define NORMAL
uniform float opacity;
#if defined( FLAT_SHADED ) || defined( USE_BUMPMAP ) || defined( USE_NORMALMAP_TANGENTSPACE )
varying vec3 vViewPosition;
#endif
#include <uv_pars_fragment>
#include <normal_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main(){
vec4 diffuseColor=vec4(0.0,0.0,0.0,opacity);
#include <clipping_planes_fragment>
#include <logdepthbuf_fragment>
#include <normal_fragment_begin>
#include <normal_fragment_maps>
gl_FragColor=vec4(normalize(normal)*0.5 + 0.5,diffuseColor.a);
#ifdef OPAQUE
gl_FragColor.a=1.0;
#endif
}`,s0=`#define PHONG
varying vec3 vViewPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <envmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <shadowmap_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main(){
#include <uv_vertex>
#include <color_vertex>
#include <morphcolor_vertex>
#include <batching_vertex>
#include <beginnormal_vertex>
#include <morphinstance_vertex>
#include <morphnormal_vertex>
#include <skinbase_vertex>
#include <skinnormal_vertex>
#include <defaultnormal_vertex>
#include <normal_vertex>
#include <begin_vertex>
#include <morphtarget_vertex>
#include <skinning_vertex>
#include <displacementmap_vertex>
#include <project_vertex>
#include <logdepthbuf_vertex>
#include <clipping_planes_vertex>
vViewPosition=- mvPosition.xyz;
#include <worldpos_vertex>
#include <envmap_vertex>
#include <shadowmap_vertex>
#include <fog_vertex>
}`,r0=`#define PHONG
uniform vec3 diffuse;
uniform vec3 emissive;
uniform vec3 specular;
uniform float shininess;
uniform float opacity;
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <emissivemap_pars_fragment>
#include <envmap_common_pars_fragment>
#include <envmap_pars_fragment>
#include <envmap_physical_pars_fragment>
#include <fog_pars_fragment>
#include <bsdfs>
#include <lights_pars_begin>
#include <normal_pars_fragment>
#include <lights_phong_pars_fragment>
#include <shadowmap_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <specularmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main(){
vec4 diffuseColor=vec4(diffuse,opacity);
#include <clipping_planes_fragment>
ReflectedLight reflectedLight=ReflectedLight(vec3(0.0),vec3(0.0),vec3(0.0),vec3(0.0));
vec3 totalEmissiveRadiance=emissive;
#include <logdepthbuf_fragment>
#include <map_fragment>
#include <color_fragment>
#include <alphamap_fragment>
#include <alphatest_fragment>
#include <alphahash_fragment>
#include <specularmap_fragment>
#include <normal_fragment_begin>
#include <normal_fragment_maps>
#include <emissivemap_fragment>
#include <lights_phong_fragment>
#include <lights_fragment_begin>
#include <lights_fragment_maps>
#include <lights_fragment_end>
#include <aomap_fragment>
vec3 outgoingLight=reflectedLight.directDiffuse + reflectedLight.indirectDiffuse + reflectedLight.directSpecular + reflectedLight.indirectSpecular + totalEmissiveRadiance;
#include <envmap_fragment>
#include <opaque_fragment>
#include <tonemapping_fragment>
#include <colorspace_fragment>
#include <fog_fragment>
#include <premultiplied_alpha_fragment>
#include <dithering_fragment>
}`,o0=`#define STANDARD
varying vec3 vViewPosition;
#ifdef USE_TRANSMISSION
varying vec3 vWorldPosition;
#endif
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <shadowmap_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main(){
#include <uv_vertex>
#include <color_vertex>
#include <morphinstance_vertex>
#include <morphcolor_vertex>
#include <batching_vertex>
#include <beginnormal_vertex>
#include <morphnormal_vertex>
#include <skinbase_vertex>
#include <skinnormal_vertex>
#include <defaultnormal_vertex>
#include <normal_vertex>
#include <begin_vertex>
#include <morphtarget_vertex>
#include <skinning_vertex>
#include <displacementmap_vertex>
#include <project_vertex>
#include <logdepthbuf_vertex>
#include <clipping_planes_vertex>
vViewPosition=- mvPosition.xyz;
#include <worldpos_vertex>
#include <shadowmap_vertex>
#include <fog_vertex>
#ifdef USE_TRANSMISSION
vWorldPosition=worldPosition.xyz;
#endif
}`,a0=`#define STANDARD
#ifdef PHYSICAL
#define IOR
#define USE_SPECULAR
#endif
uniform vec3 diffuse;
uniform vec3 emissive;
uniform float roughness;
uniform float metalness;
uniform float opacity;
#ifdef IOR
uniform float ior;
#endif
#ifdef USE_SPECULAR
uniform float specularIntensity;
uniform vec3 specularColor;
#ifdef USE_SPECULAR_COLORMAP
uniform sampler2D specularColorMap;
#endif
#ifdef USE_SPECULAR_INTENSITYMAP
uniform sampler2D specularIntensityMap;
#endif
#endif
#ifdef USE_CLEARCOAT
uniform float clearcoat;
uniform float clearcoatRoughness;
#endif
#ifdef USE_DIFFUSE_ROUGHNESS
uniform float diffuseRoughness;
#ifdef USE_DIFFUSE_ROUGHNESSMAP
uniform sampler2D diffuseRoughnessMap;
#endif
#endif
#ifdef USE_DISPERSION
uniform float dispersion;
#endif
#ifdef USE_RETROREFLECTION
uniform float retroreflectivity;
#endif
#ifdef USE_IRIDESCENCE
uniform float iridescence;
uniform float iridescenceIOR;
uniform float iridescenceThicknessMinimum;
uniform float iridescenceThicknessMaximum;
#endif
#ifdef USE_SHEEN
uniform vec3 sheenColor;
uniform float sheenRoughness;
#ifdef USE_SHEEN_COLORMAP
uniform sampler2D sheenColorMap;
#endif
#ifdef USE_SHEEN_ROUGHNESSMAP
uniform sampler2D sheenRoughnessMap;
#endif
#endif
#ifdef USE_ANISOTROPY
uniform vec2 anisotropyVector;
#ifdef USE_ANISOTROPYMAP
uniform sampler2D anisotropyMap;
#endif
#endif
varying vec3 vViewPosition;
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <emissivemap_pars_fragment>
#include <iridescence_fragment>
#include <envmap_common_pars_fragment>
#include <envmap_physical_pars_fragment>
#include <fog_pars_fragment>
#include <lights_pars_begin>
#include <normal_pars_fragment>
#include <lights_physical_pars_fragment>
#include <transmission_pars_fragment>
#include <shadowmap_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <clearcoat_pars_fragment>
#include <iridescence_pars_fragment>
#include <roughnessmap_pars_fragment>
#include <metalnessmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main(){
vec4 diffuseColor=vec4(diffuse,opacity);
#include <clipping_planes_fragment>
ReflectedLight reflectedLight=ReflectedLight(vec3(0.0),vec3(0.0),vec3(0.0),vec3(0.0));
vec3 totalEmissiveRadiance=emissive;
#include <logdepthbuf_fragment>
#include <map_fragment>
#include <color_fragment>
#include <alphamap_fragment>
#include <alphatest_fragment>
#include <alphahash_fragment>
#include <roughnessmap_fragment>
#include <metalnessmap_fragment>
#include <normal_fragment_begin>
#include <normal_fragment_maps>
#include <clearcoat_normal_fragment_begin>
#include <clearcoat_normal_fragment_maps>
#include <emissivemap_fragment>
#include <lights_physical_fragment>
#include <lights_fragment_begin>
#include <lights_fragment_maps>
#include <lights_fragment_end>
#include <aomap_fragment>
vec3 totalDiffuse=reflectedLight.directDiffuse + reflectedLight.indirectDiffuse;
vec3 totalSpecular=reflectedLight.directSpecular + reflectedLight.indirectSpecular;
#include <transmission_fragment>
vec3 outgoingLight=totalDiffuse + totalSpecular + totalEmissiveRadiance;
#ifdef USE_SHEEN
outgoingLight=outgoingLight + sheenSpecularDirect + sheenSpecularIndirect;
#endif
#ifdef USE_CLEARCOAT
float dotNVcc=saturate(dot(geometryClearcoatNormal,geometryViewDir));
vec3 Fcc=F_Schlick(material.clearcoatF0,material.clearcoatF90,dotNVcc);
outgoingLight=outgoingLight*(1.0 - material.clearcoat*Fcc)+(clearcoatSpecularDirect + clearcoatSpecularIndirect)*material.clearcoat;
#endif
#include <opaque_fragment>
#include <tonemapping_fragment>
#include <colorspace_fragment>
#include <fog_fragment>
#include <premultiplied_alpha_fragment>
#include <dithering_fragment>
}`,l0=`#define TOON
varying vec3 vViewPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <shadowmap_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main(){
#include <uv_vertex>
#include <color_vertex>
#include <morphinstance_vertex>
#include <morphcolor_vertex>
#include <batching_vertex>
#include <beginnormal_vertex>
#include <morphnormal_vertex>
#include <skinbase_vertex>
#include <skinnormal_vertex>
#include <defaultnormal_vertex>
#include <normal_vertex>
#include <begin_vertex>
#include <morphtarget_vertex>
#include <skinning_vertex>
#include <displacementmap_vertex>
#include <project_vertex>
#include <logdepthbuf_vertex>
#include <clipping_planes_vertex>
vViewPosition=- mvPosition.xyz;
#include <worldpos_vertex>
#include <shadowmap_vertex>
#include <fog_vertex>
}`,c0=`#define TOON
uniform vec3 diffuse;
uniform vec3 emissive;
uniform float opacity;
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <emissivemap_pars_fragment>
#include <gradientmap_pars_fragment>
#include <fog_pars_fragment>
#include <bsdfs>
#include <lights_pars_begin>
#include <normal_pars_fragment>
#include <lights_toon_pars_fragment>
#include <shadowmap_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main(){
vec4 diffuseColor=vec4(diffuse,opacity);
#include <clipping_planes_fragment>
ReflectedLight reflectedLight=ReflectedLight(vec3(0.0),vec3(0.0),vec3(0.0),vec3(0.0));
vec3 totalEmissiveRadiance=emissive;
#include <logdepthbuf_fragment>
#include <map_fragment>
#include <color_fragment>
#include <alphamap_fragment>
#include <alphatest_fragment>
#include <alphahash_fragment>
#include <normal_fragment_begin>
#include <normal_fragment_maps>
#include <emissivemap_fragment>
#include <lights_toon_fragment>
#include <lights_fragment_begin>
#include <lights_fragment_maps>
#include <lights_fragment_end>
#include <aomap_fragment>
vec3 outgoingLight=reflectedLight.directDiffuse + reflectedLight.indirectDiffuse + totalEmissiveRadiance;
#include <opaque_fragment>
#include <tonemapping_fragment>
#include <colorspace_fragment>
#include <fog_fragment>
#include <premultiplied_alpha_fragment>
#include <dithering_fragment>
}`,h0=`uniform float size;
uniform float scale;
#include <common>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <morphtarget_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
#ifdef USE_POINTS_UV
varying vec2 vUv;
uniform mat3 uvTransform;
#endif
void main(){
#ifdef USE_POINTS_UV
vUv=(uvTransform*vec3(uv,1)).xy;
#endif
#include <color_vertex>
#include <morphinstance_vertex>
#include <morphcolor_vertex>
#include <begin_vertex>
#include <morphtarget_vertex>
#include <project_vertex>
gl_PointSize=size;
#ifdef USE_SIZEATTENUATION
bool isPerspective=isPerspectiveMatrix(projectionMatrix);
if(isPerspective)gl_PointSize*=(scale / - mvPosition.z);
#endif
#include <logdepthbuf_vertex>
#include <clipping_planes_vertex>
#include <worldpos_vertex>
#include <fog_vertex>
}`,u0=`uniform vec3 diffuse;
uniform float opacity;
#include <common>
#include <color_pars_fragment>
#include <map_particle_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <fog_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main(){
vec4 diffuseColor=vec4(diffuse,opacity);
#include <clipping_planes_fragment>
vec3 outgoingLight=vec3(0.0);
#include <logdepthbuf_fragment>
#include <map_particle_fragment>
#include <color_fragment>
#include <alphatest_fragment>
#include <alphahash_fragment>
outgoingLight=diffuseColor.rgb;
#include <opaque_fragment>
#include <tonemapping_fragment>
#include <colorspace_fragment>
#include <fog_fragment>
#include <premultiplied_alpha_fragment>
}`,d0=`#include <common>
#include <batching_pars_vertex>
#include <fog_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <shadowmap_pars_vertex>
void main(){
#include <batching_vertex>
#include <beginnormal_vertex>
#include <morphinstance_vertex>
#include <morphnormal_vertex>
#include <skinbase_vertex>
#include <skinnormal_vertex>
#include <defaultnormal_vertex>
#include <begin_vertex>
#include <morphtarget_vertex>
#include <skinning_vertex>
#include <project_vertex>
#include <logdepthbuf_vertex>
#include <worldpos_vertex>
#include <shadowmap_vertex>
#include <fog_vertex>
}`,f0=`uniform vec3 color;
uniform float opacity;
#include <common>
#include <fog_pars_fragment>
#include <bsdfs>
#include <lights_pars_begin>
#include <logdepthbuf_pars_fragment>
#include <shadowmap_pars_fragment>
#include <shadowmask_pars_fragment>
void main(){
#include <logdepthbuf_fragment>
gl_FragColor=vec4(color,opacity*(1.0 - getShadowMask()));
#include <tonemapping_fragment>
#include <colorspace_fragment>
#include <fog_fragment>
#include <premultiplied_alpha_fragment>
}`,p0=`uniform float rotation;
uniform vec2 center;
#include <common>
#include <uv_pars_vertex>
#include <fog_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main(){
#include <uv_vertex>
vec4 mvPosition=modelViewMatrix[ 3 ];
vec2 scale=vec2(length(modelMatrix[ 0 ].xyz),length(modelMatrix[ 1 ].xyz));
#ifndef USE_SIZEATTENUATION
bool isPerspective=isPerspectiveMatrix(projectionMatrix);
if(isPerspective)scale*=- mvPosition.z;
#endif
vec2 alignedPosition=(position.xy -(center - vec2(0.5)))*scale;
vec2 rotatedPosition;
rotatedPosition.x=cos(rotation)*alignedPosition.x - sin(rotation)*alignedPosition.y;
rotatedPosition.y=sin(rotation)*alignedPosition.x + cos(rotation)*alignedPosition.y;
mvPosition.xy +=rotatedPosition;
gl_Position=projectionMatrix*mvPosition;
#include <logdepthbuf_vertex>
#include <clipping_planes_vertex>
#include <fog_vertex>
}`,m0=`uniform vec3 diffuse;
uniform float opacity;
#include <common>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <fog_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main(){
vec4 diffuseColor=vec4(diffuse,opacity);
#include <clipping_planes_fragment>
vec3 outgoingLight=vec3(0.0);
#include <logdepthbuf_fragment>
#include <map_fragment>
#include <alphamap_fragment>
#include <alphatest_fragment>
#include <alphahash_fragment>
outgoingLight=diffuseColor.rgb;
#include <opaque_fragment>
#include <tonemapping_fragment>
#include <colorspace_fragment>
#include <fog_fragment>
}`,Ve={alphahash_fragment:Op,alphahash_pars_fragment:Bp,alphamap_fragment:kp,alphamap_pars_fragment:zp,alphatest_fragment:Vp,alphatest_pars_fragment:Gp,aomap_fragment:Hp,aomap_pars_fragment:Wp,batching_pars_vertex:Xp,batching_vertex:qp,begin_vertex:Yp,beginnormal_vertex:$p,bsdfs:Zp,iridescence_fragment:Jp,bumpmap_pars_fragment:Kp,clipping_planes_fragment:jp,clipping_planes_pars_fragment:Qp,clipping_planes_pars_vertex:em,clipping_planes_vertex:tm,color_fragment:nm,color_pars_fragment:im,color_pars_vertex:sm,color_vertex:rm,common:om,defaultnormal_vertex:am,displacementmap_pars_vertex:lm,displacementmap_vertex:cm,emissivemap_fragment:hm,emissivemap_pars_fragment:um,colorspace_fragment:dm,colorspace_pars_fragment:fm,envmap_fragment:pm,envmap_common_pars_fragment:mm,envmap_pars_fragment:gm,envmap_pars_vertex:ym,envmap_physical_pars_fragment:Rm,envmap_vertex:xm,fog_vertex:vm,fog_pars_vertex:_m,fog_fragment:bm,fog_pars_fragment:Mm,gradientmap_pars_fragment:Sm,lightmap_pars_fragment:wm,lights_lambert_fragment:Em,lights_lambert_pars_fragment:Am,lights_pars_begin:Tm,lights_toon_fragment:Cm,lights_toon_pars_fragment:Pm,lights_phong_fragment:Im,lights_phong_pars_fragment:Lm,lights_physical_fragment:Nm,lights_physical_pars_fragment:Dm,lights_fragment_begin:Fm,lights_fragment_maps:Um,lights_fragment_end:Om,lightprobes_pars_fragment:Bm,logdepthbuf_fragment:km,logdepthbuf_pars_fragment:zm,logdepthbuf_pars_vertex:Vm,logdepthbuf_vertex:Gm,map_fragment:Hm,map_pars_fragment:Wm,map_particle_fragment:Xm,map_particle_pars_fragment:qm,metalnessmap_fragment:Ym,metalnessmap_pars_fragment:$m,morphinstance_vertex:Zm,morphcolor_vertex:Jm,morphnormal_vertex:Km,morphtarget_pars_vertex:jm,morphtarget_vertex:Qm,normal_fragment_begin:eg,normal_fragment_maps:tg,normal_pars_fragment:ng,normal_pars_vertex:ig,normal_vertex:sg,normalmap_pars_fragment:rg,clearcoat_normal_fragment_begin:og,clearcoat_normal_fragment_maps:ag,clearcoat_pars_fragment:lg,iridescence_pars_fragment:cg,opaque_fragment:hg,packing:ug,premultiplied_alpha_fragment:dg,project_vertex:fg,dithering_fragment:pg,dithering_pars_fragment:mg,roughnessmap_fragment:gg,roughnessmap_pars_fragment:yg,shadowmap_pars_fragment:xg,shadowmap_pars_vertex:vg,shadowmap_vertex:_g,shadowmask_pars_fragment:bg,skinbase_vertex:Mg,skinning_pars_vertex:Sg,skinning_vertex:wg,skinnormal_vertex:Eg,specularmap_fragment:Ag,specularmap_pars_fragment:Tg,tonemapping_fragment:Rg,tonemapping_pars_fragment:Cg,transmission_fragment:Pg,transmission_pars_fragment:Ig,uv_pars_fragment:Lg,uv_pars_vertex:Ng,uv_vertex:Dg,worldpos_vertex:Fg,background_vert:Ug,background_frag:Og,backgroundCube_vert:Bg,backgroundCube_frag:kg,cube_vert:zg,cube_frag:Vg,depth_vert:Gg,depth_frag:Hg,distance_vert:Wg,distance_frag:Xg,equirect_vert:qg,equirect_frag:Yg,linedashed_vert:$g,linedashed_frag:Zg,meshbasic_vert:Jg,meshbasic_frag:Kg,meshlambert_vert:jg,meshlambert_frag:Qg,meshmatcap_vert:e0,meshmatcap_frag:t0,meshnormal_vert:n0,meshnormal_frag:i0,meshphong_vert:s0,meshphong_frag:r0,meshphysical_vert:o0,meshphysical_frag:a0,meshtoon_vert:l0,meshtoon_frag:c0,points_vert:h0,points_frag:u0,shadow_vert:d0,shadow_frag:f0,sprite_vert:p0,sprite_frag:m0},pe={common:{diffuse:{value:new Ie(16777215)},opacity:{value:1},map:{value:null},mapTransform:{value:new Ne},alphaMap:{value:null},alphaMapTransform:{value:new Ne},alphaTest:{value:0}},specularmap:{specularMap:{value:null},specularMapTransform:{value:new Ne}},envmap:{envMap:{value:null},envMapRotation:{value:new Ne},reflectivity:{value:1},ior:{value:1.5},refractionRatio:{value:.98},dfgLUT:{value:null}},aomap:{aoMap:{value:null},aoMapIntensity:{value:1},aoMapTransform:{value:new Ne}},lightmap:{lightMap:{value:null},lightMapIntensity:{value:1},lightMapTransform:{value:new Ne}},bumpmap:{bumpMap:{value:null},bumpMapTransform:{value:new Ne},bumpScale:{value:1}},normalmap:{normalMap:{value:null},normalMapTransform:{value:new Ne},normalScale:{value:new Be(1,1)}},displacementmap:{displacementMap:{value:null},displacementMapTransform:{value:new Ne},displacementScale:{value:1},displacementBias:{value:0}},emissivemap:{emissiveMap:{value:null},emissiveMapTransform:{value:new Ne}},metalnessmap:{metalnessMap:{value:null},metalnessMapTransform:{value:new Ne}},roughnessmap:{roughnessMap:{value:null},roughnessMapTransform:{value:new Ne}},gradientmap:{gradientMap:{value:null}},fog:{fogDensity:{value:25e-5},fogNear:{value:1},fogFar:{value:2e3},fogColor:{value:new Ie(16777215)}},lights:{ambientLightColor:{value:[]},lightProbe:{value:[]},sunLights:{value:[],properties:{direction:{},color:{}}},sunLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{}}},sunShadowMatrix:{value:[]},sunShadowCascade:{value:[]},directionalLights:{value:[],properties:{direction:{},color:{}}},directionalLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{}}},directionalShadowMatrix:{value:[]},spotLights:{value:[],properties:{color:{},position:{},direction:{},distance:{},coneCos:{},penumbraCos:{},decay:{}}},spotLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{}}},spotLightMap:{value:[]},spotLightMatrix:{value:[]},pointLights:{value:[],properties:{color:{},position:{},decay:{},distance:{}}},pointLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{},shadowCameraNear:{},shadowCameraFar:{}}},pointShadowMatrix:{value:[]},hemisphereLights:{value:[],properties:{direction:{},skyColor:{},groundColor:{}}},rectAreaLights:{value:[],properties:{color:{},position:{},width:{},height:{}}},ltc_1:{value:null},ltc_2:{value:null},probesSH:{value:[]},probesMin:{value:[]},probesMax:{value:[]},probesResolution:{value:[]}},points:{diffuse:{value:new Ie(16777215)},opacity:{value:1},size:{value:1},scale:{value:1},map:{value:null},alphaMap:{value:null},alphaMapTransform:{value:new Ne},alphaTest:{value:0},uvTransform:{value:new Ne}},sprite:{diffuse:{value:new Ie(16777215)},opacity:{value:1},center:{value:new Be(.5,.5)},rotation:{value:0},map:{value:null},mapTransform:{value:new Ne},alphaMap:{value:null},alphaMapTransform:{value:new Ne},alphaTest:{value:0}}},An={basic:{uniforms:Ft([pe.common,pe.specularmap,pe.envmap,pe.aomap,pe.lightmap,pe.fog]),vertexShader:Ve.meshbasic_vert,fragmentShader:Ve.meshbasic_frag},lambert:{uniforms:Ft([pe.common,pe.specularmap,pe.envmap,pe.aomap,pe.lightmap,pe.emissivemap,pe.bumpmap,pe.normalmap,pe.displacementmap,pe.fog,pe.lights,{emissive:{value:new Ie(0)},envMapIntensity:{value:1}}]),vertexShader:Ve.meshlambert_vert,fragmentShader:Ve.meshlambert_frag},phong:{uniforms:Ft([pe.common,pe.specularmap,pe.envmap,pe.aomap,pe.lightmap,pe.emissivemap,pe.bumpmap,pe.normalmap,pe.displacementmap,pe.fog,pe.lights,{emissive:{value:new Ie(0)},specular:{value:new Ie(1118481)},shininess:{value:30},envMapIntensity:{value:1}}]),vertexShader:Ve.meshphong_vert,fragmentShader:Ve.meshphong_frag},standard:{uniforms:Ft([pe.common,pe.envmap,pe.aomap,pe.lightmap,pe.emissivemap,pe.bumpmap,pe.normalmap,pe.displacementmap,pe.roughnessmap,pe.metalnessmap,pe.fog,pe.lights,{emissive:{value:new Ie(0)},roughness:{value:1},metalness:{value:0},envMapIntensity:{value:1}}]),vertexShader:Ve.meshphysical_vert,fragmentShader:Ve.meshphysical_frag},toon:{uniforms:Ft([pe.common,pe.aomap,pe.lightmap,pe.emissivemap,pe.bumpmap,pe.normalmap,pe.displacementmap,pe.gradientmap,pe.fog,pe.lights,{emissive:{value:new Ie(0)}}]),vertexShader:Ve.meshtoon_vert,fragmentShader:Ve.meshtoon_frag},matcap:{uniforms:Ft([pe.common,pe.bumpmap,pe.normalmap,pe.displacementmap,pe.fog,{matcap:{value:null}}]),vertexShader:Ve.meshmatcap_vert,fragmentShader:Ve.meshmatcap_frag},points:{uniforms:Ft([pe.points,pe.fog]),vertexShader:Ve.points_vert,fragmentShader:Ve.points_frag},dashed:{uniforms:Ft([pe.common,pe.fog,{scale:{value:1},dashSize:{value:1},totalSize:{value:2}}]),vertexShader:Ve.linedashed_vert,fragmentShader:Ve.linedashed_frag},depth:{uniforms:Ft([pe.common,pe.displacementmap]),vertexShader:Ve.depth_vert,fragmentShader:Ve.depth_frag},normal:{uniforms:Ft([pe.common,pe.bumpmap,pe.normalmap,pe.displacementmap,{opacity:{value:1}}]),vertexShader:Ve.meshnormal_vert,fragmentShader:Ve.meshnormal_frag},sprite:{uniforms:Ft([pe.sprite,pe.fog]),vertexShader:Ve.sprite_vert,fragmentShader:Ve.sprite_frag},background:{uniforms:{uvTransform:{value:new Ne},t2D:{value:null},backgroundIntensity:{value:1}},vertexShader:Ve.background_vert,fragmentShader:Ve.background_frag},backgroundCube:{uniforms:{envMap:{value:null},backgroundBlurriness:{value:0},backgroundIntensity:{value:1},backgroundRotation:{value:new Ne}},vertexShader:Ve.backgroundCube_vert,fragmentShader:Ve.backgroundCube_frag},cube:{uniforms:{tCube:{value:null},tFlip:{value:-1},opacity:{value:1}},vertexShader:Ve.cube_vert,fragmentShader:Ve.cube_frag},equirect:{uniforms:{tEquirect:{value:null}},vertexShader:Ve.equirect_vert,fragmentShader:Ve.equirect_frag},distance:{uniforms:Ft([pe.common,pe.displacementmap,{referencePosition:{value:new U},nearDistance:{value:1},farDistance:{value:1e3}}]),vertexShader:Ve.distance_vert,fragmentShader:Ve.distance_frag},shadow:{uniforms:Ft([pe.lights,pe.fog,{color:{value:new Ie(0)},opacity:{value:1}}]),vertexShader:Ve.shadow_vert,fragmentShader:Ve.shadow_frag}};An.physical={uniforms:Ft([An.standard.uniforms,{clearcoat:{value:0},clearcoatMap:{value:null},clearcoatMapTransform:{value:new Ne},clearcoatNormalMap:{value:null},clearcoatNormalMapTransform:{value:new Ne},clearcoatNormalScale:{value:new Be(1,1)},clearcoatRoughness:{value:0},clearcoatRoughnessMap:{value:null},clearcoatRoughnessMapTransform:{value:new Ne},diffuseRoughness:{value:0},diffuseRoughnessMap:{value:null},diffuseRoughnessMapTransform:{value:new Ne},dispersion:{value:0},retroreflectivity:{value:0},iridescence:{value:0},iridescenceMap:{value:null},iridescenceMapTransform:{value:new Ne},iridescenceIOR:{value:1.3},iridescenceThicknessMinimum:{value:100},iridescenceThicknessMaximum:{value:400},iridescenceThicknessMap:{value:null},iridescenceThicknessMapTransform:{value:new Ne},sheen:{value:0},sheenColor:{value:new Ie(0)},sheenColorMap:{value:null},sheenColorMapTransform:{value:new Ne},sheenRoughness:{value:1},sheenRoughnessMap:{value:null},sheenRoughnessMapTransform:{value:new Ne},transmission:{value:0},transmissionMap:{value:null},transmissionMapTransform:{value:new Ne},transmissionSamplerSize:{value:new Be},transmissionSamplerMap:{value:null},thickness:{value:0},thicknessMap:{value:null},thicknessMapTransform:{value:new Ne},attenuationDistance:{value:0},attenuationColor:{value:new Ie(0)},specularColor:{value:new Ie(1,1,1)},specularColorMap:{value:null},specularColorMapTransform:{value:new Ne},specularIntensity:{value:1},specularIntensityMap:{value:null},specularIntensityMapTransform:{value:new Ne},anisotropyVector:{value:new Be},anisotropyMap:{value:null},anisotropyMapTransform:{value:new Ne}}]),vertexShader:Ve.meshphysical_vert,fragmentShader:Ve.meshphysical_frag};var Da={r:0,b:0,g:0},g0=new je,bd=new Ne;bd.set(-1,0,0,0,1,0,0,0,1);function y0(s,e,t,n,i,r){let o=new Ie(0),a=i===!0?0:1,l,c,h=null,u=0,f=null;function d(b){let T=b.isScene===!0?b.background:null;if(T&&T.isTexture){let E=b.backgroundBlurriness>0;T=e.get(T,E)}return T}function g(b){let T=!1,E=d(b);E===null?p(o,a):E&&E.isColor&&(p(E,1),T=!0);let M=s.xr.getEnvironmentBlendMode();M==="additive"?t.buffers.color.setClear(0,0,0,1,r):M==="alpha-blend"&&t.buffers.color.setClear(0,0,0,0,r),(s.autoClear||T)&&(t.buffers.depth.setTest(!0),t.buffers.depth.setMask(!0),t.buffers.color.setMask(!0),s.clear(s.autoClearColor,s.autoClearDepth,s.autoClearStencil))}function x(b,T){let E=d(T);E&&E.isCubeTexture?(c===void 0&&(c=new ht(new ii(1,1,1),new Dt({name:"BackgroundCubeMaterial",uniforms:wi(An.backgroundCube.uniforms),vertexShader:An.backgroundCube.vertexShader,fragmentShader:An.backgroundCube.fragmentShader,side:Ct,depthTest:!1,depthWrite:!1,fog:!1,allowOverride:!1})),c.geometry.deleteAttribute("normal"),c.geometry.deleteAttribute("uv"),c.onBeforeRender=function(M,w,y){this.matrixWorld.copyPosition(y.matrixWorld)},Object.defineProperty(c.material,"envMap",{get:function(){return this.uniforms.envMap.value}}),n.update(c)),c.material.uniforms.envMap.value=E,c.material.uniforms.backgroundBlurriness.value=T.backgroundBlurriness,c.material.uniforms.backgroundIntensity.value=T.backgroundIntensity,c.material.uniforms.backgroundRotation.value.setFromMatrix4(g0.makeRotationFromEuler(T.backgroundRotation)).transpose(),E.isRenderTargetTexture===!1&&c.material.uniforms.backgroundRotation.value.premultiply(bd),c.material.toneMapped=Xe.getTransfer(E.colorSpace)!==Ze,(h!==E||u!==E.version||f!==s.toneMapping)&&(c.material.needsUpdate=!0,h=E,u=E.version,f=s.toneMapping),c.layers.enableAll(),b.unshift(c,c.geometry,c.material,0,0,null)):E&&E.isTexture&&(l===void 0&&(l=new ht(new Vn(2,2),new Dt({name:"BackgroundMaterial",uniforms:wi(An.background.uniforms),vertexShader:An.background.vertexShader,fragmentShader:An.background.fragmentShader,side:li,depthTest:!1,depthWrite:!1,fog:!1,allowOverride:!1})),l.geometry.deleteAttribute("normal"),Object.defineProperty(l.material,"map",{get:function(){return this.uniforms.t2D.value}}),n.update(l)),l.material.uniforms.t2D.value=E,l.material.uniforms.backgroundIntensity.value=T.backgroundIntensity,l.material.toneMapped=Xe.getTransfer(E.colorSpace)!==Ze,E.matrixAutoUpdate===!0&&E.updateMatrix(),l.material.uniforms.uvTransform.value.copy(E.matrix),(h!==E||u!==E.version||f!==s.toneMapping)&&(l.material.needsUpdate=!0,h=E,u=E.version,f=s.toneMapping),l.layers.enableAll(),b.unshift(l,l.geometry,l.material,0,0,null))}function p(b,T){b.getRGB(Da,Dc(s)),t.buffers.color.setClear(Da.r,Da.g,Da.b,T,r)}function m(){c!==void 0&&(c.geometry.dispose(),c.material.dispose(),c=void 0),l!==void 0&&(l.geometry.dispose(),l.material.dispose(),l=void 0)}return{getClearColor:function(){return o},setClearColor:function(b,T=1){o.set(b),a=T,p(o,a)},getClearAlpha:function(){return a},setClearAlpha:function(b){a=b,p(o,a)},render:g,addToRenderList:x,dispose:m}}function x0(s,e){let t=s.getParameter(s.MAX_VERTEX_ATTRIBS),n={},i=f(null),r=i,o=!1;function a(N,O,D,P,V){let W=!1,G=u(N,P,D,O);r!==G&&(r=G,c(r.object)),W=d(N,P,D,V),W&&g(N,P,D,V),V!==null&&e.update(V,s.ELEMENT_ARRAY_BUFFER),(W||o)&&(o=!1,E(N,O,D,P),V!==null&&s.bindBuffer(s.ELEMENT_ARRAY_BUFFER,e.get(V).buffer))}function l(){return s.createVertexArray()}function c(N){return s.bindVertexArray(N)}function h(N){return s.deleteVertexArray(N)}function u(N,O,D,P){let V=P.wireframe===!0,W=n[O.id];W===void 0&&(W={},n[O.id]=W);let G=N.isInstancedMesh===!0?N.id:0,ee=W[G];ee===void 0&&(ee={},W[G]=ee);let X=ee[D.id];X===void 0&&(X={},ee[D.id]=X);let Q=X[V];return Q===void 0&&(Q=f(l()),X[V]=Q),Q}function f(N){let O=[],D=[],P=[];for(let V=0;V<t;V++)O[V]=0,D[V]=0,P[V]=0;return{geometry:null,program:null,wireframe:!1,newAttributes:O,enabledAttributes:D,attributeDivisors:P,object:N,attributes:{},index:null}}function d(N,O,D,P){let V=r.attributes,W=O.attributes,G=0,ee=D.getAttributes();for(let X in ee)if(ee[X].location>=0){let te=V[X],Me=W[X];if(Me===void 0&&(X==="instanceMatrix"&&N.instanceMatrix&&(Me=N.instanceMatrix),X==="instanceColor"&&N.instanceColor&&(Me=N.instanceColor)),te===void 0||te.attribute!==Me||Me&&te.data!==Me.data)return!0;G++}return r.attributesNum!==G||r.index!==P}function g(N,O,D,P){let V={},W=O.attributes,G=0,ee=D.getAttributes();for(let X in ee)if(ee[X].location>=0){let te=W[X];te===void 0&&(X==="instanceMatrix"&&N.instanceMatrix&&(te=N.instanceMatrix),X==="instanceColor"&&N.instanceColor&&(te=N.instanceColor));let Me={};Me.attribute=te,te&&te.data&&(Me.data=te.data),V[X]=Me,G++}r.attributes=V,r.attributesNum=G,r.index=P}function x(){let N=r.newAttributes;for(let O=0,D=N.length;O<D;O++)N[O]=0}function p(N){m(N,0)}function m(N,O){let D=r.newAttributes,P=r.enabledAttributes,V=r.attributeDivisors;D[N]=1,P[N]===0&&(s.enableVertexAttribArray(N),P[N]=1),V[N]!==O&&(s.vertexAttribDivisor(N,O),V[N]=O)}function b(){let N=r.newAttributes,O=r.enabledAttributes;for(let D=0,P=O.length;D<P;D++)O[D]!==N[D]&&(s.disableVertexAttribArray(D),O[D]=0)}function T(N,O,D,P,V,W,G){G===!0?s.vertexAttribIPointer(N,O,D,V,W):s.vertexAttribPointer(N,O,D,P,V,W)}function E(N,O,D,P){x();let V=P.attributes,W=D.getAttributes(),G=O.defaultAttributeValues;for(let ee in W){let X=W[ee];if(X.location>=0){let Q=V[ee];if(Q===void 0&&(ee==="instanceMatrix"&&N.instanceMatrix&&(Q=N.instanceMatrix),ee==="instanceColor"&&N.instanceColor&&(Q=N.instanceColor)),Q!==void 0){let te=Q.normalized,Me=Q.itemSize,Fe=e.get(Q);if(Fe===void 0)continue;let J=Fe.buffer,me=Fe.type,ve=Fe.bytesPerElement,Te=me===s.INT||me===s.UNSIGNED_INT||Q.gpuType===Ko;if(Q.isInterleavedBufferAttribute){let ge=Q.data,Oe=ge.isInterleavedBuffer===!0?ge.stride:ge.itemSize,dt=Q.offset;if(ge.isInstancedInterleavedBuffer||ge.isInstancedBufferAttribute){for(let Pe=0;Pe<X.locationSize;Pe++)m(X.location+Pe,ge.meshPerAttribute);N.isInstancedMesh!==!0&&P._maxInstanceCount===void 0&&(P._maxInstanceCount=ge.meshPerAttribute*ge.count)}else for(let Pe=0;Pe<X.locationSize;Pe++)p(X.location+Pe);s.bindBuffer(s.ARRAY_BUFFER,J);for(let Pe=0;Pe<X.locationSize;Pe++)T(X.location+Pe,Me/X.locationSize,me,te,Oe*ve,(dt+Me/X.locationSize*Pe)*ve,Te)}else{if(Q.isInstancedBufferAttribute){for(let ge=0;ge<X.locationSize;ge++)m(X.location+ge,Q.meshPerAttribute);N.isInstancedMesh!==!0&&P._maxInstanceCount===void 0&&(P._maxInstanceCount=Q.meshPerAttribute*Q.count)}else for(let ge=0;ge<X.locationSize;ge++)p(X.location+ge);s.bindBuffer(s.ARRAY_BUFFER,J);for(let ge=0;ge<X.locationSize;ge++)T(X.location+ge,Me/X.locationSize,me,te,Me*ve,Me/X.locationSize*ge*ve,Te)}}else if(G!==void 0){let te=G[ee];if(te!==void 0)switch(te.length){case 2:s.vertexAttrib2fv(X.location,te);break;case 3:s.vertexAttrib3fv(X.location,te);break;case 4:s.vertexAttrib4fv(X.location,te);break;default:s.vertexAttrib1fv(X.location,te)}}}}b()}function M(){I();for(let N in n){let O=n[N];for(let D in O){let P=O[D];for(let V in P){let W=P[V];for(let G in W)h(W[G].object),delete W[G];delete P[V]}}delete n[N]}}function w(N){if(n[N.id]===void 0)return;let O=n[N.id];for(let D in O){let P=O[D];for(let V in P){let W=P[V];for(let G in W)h(W[G].object),delete W[G];delete P[V]}}delete n[N.id]}function y(N){for(let O in n){let D=n[O];for(let P in D){let V=D[P];if(V[N.id]===void 0)continue;let W=V[N.id];for(let G in W)h(W[G].object),delete W[G];delete V[N.id]}}}function S(N){for(let O in n){let D=n[O],P=N.isInstancedMesh===!0?N.id:0,V=D[P];if(V!==void 0){for(let W in V){let G=V[W];for(let ee in G)h(G[ee].object),delete G[ee];delete V[W]}delete D[P],Object.keys(D).length===0&&delete n[O]}}}function I(){R(),o=!0,r!==i&&(r=i,c(r.object))}function R(){i.geometry=null,i.program=null,i.wireframe=!1}return{setup:a,reset:I,resetDefaultState:R,dispose:M,releaseStatesOfGeometry:w,releaseStatesOfObject:S,releaseStatesOfProgram:y,initAttributes:x,enableAttribute:p,disableUnusedAttributes:b}}function v0(s,e,t){let n;function i(l){n=l}function r(l,c){s.drawArrays(n,l,c),t.update(c,n,1)}function o(l,c,h){h!==0&&(s.drawArraysInstanced(n,l,c,h),t.update(c,n,h))}function a(l,c,h){if(h===0)return;e.get("WEBGL_multi_draw").multiDrawArraysWEBGL(n,l,0,c,0,h);let f=0;for(let d=0;d<h;d++)f+=c[d];t.update(f,n,1)}this.setMode=i,this.render=r,this.renderInstances=o,this.renderMultiDraw=a}function _0(s,e,t,n){let i;function r(){if(i!==void 0)return i;if(e.has("EXT_texture_filter_anisotropic")===!0){let y=e.get("EXT_texture_filter_anisotropic");i=s.getParameter(y.MAX_TEXTURE_MAX_ANISOTROPY_EXT)}else i=0;return i}function o(y){return!(y!==mn&&n.convert(y)!==s.getParameter(s.IMPLEMENTATION_COLOR_READ_FORMAT))}function a(y){let S=y===pn&&(e.has("EXT_color_buffer_half_float")||e.has("EXT_color_buffer_float"));return!(y!==Ht&&y!==fn&&!S&&n.convert(y)!==s.getParameter(s.IMPLEMENTATION_COLOR_READ_TYPE))}function l(y){if(y==="highp"){if(s.getShaderPrecisionFormat(s.VERTEX_SHADER,s.HIGH_FLOAT).precision>0&&s.getShaderPrecisionFormat(s.FRAGMENT_SHADER,s.HIGH_FLOAT).precision>0)return"highp";y="mediump"}return y==="mediump"&&s.getShaderPrecisionFormat(s.VERTEX_SHADER,s.MEDIUM_FLOAT).precision>0&&s.getShaderPrecisionFormat(s.FRAGMENT_SHADER,s.MEDIUM_FLOAT).precision>0?"mediump":"lowp"}let c=t.precision!==void 0?t.precision:"highp",h=l(c);h!==c&&(Ce("WebGLRenderer:",c,"not supported, using",h,"instead."),c=h);let u=t.reversedDepthBuffer===!0&&e.has("EXT_clip_control"),f=t.logarithmicDepthBuffer===!0&&u===!1;t.reversedDepthBuffer===!0&&u===!1&&Ce("WebGLRenderer: Unable to use reversed depth buffer due to missing EXT_clip_control extension. Fallback to default depth buffer."),t.logarithmicDepthBuffer===!0&&u===!0&&Ce("WebGLRenderer: Logarithmic depth buffer is ignored when reversed depth buffer is enabled.");let d=s.getParameter(s.MAX_TEXTURE_IMAGE_UNITS),g=s.getParameter(s.MAX_VERTEX_TEXTURE_IMAGE_UNITS),x=s.getParameter(s.MAX_TEXTURE_SIZE),p=s.getParameter(s.MAX_CUBE_MAP_TEXTURE_SIZE),m=s.getParameter(s.MAX_VERTEX_ATTRIBS),b=s.getParameter(s.MAX_VERTEX_UNIFORM_VECTORS),T=s.getParameter(s.MAX_VARYING_VECTORS),E=s.getParameter(s.MAX_FRAGMENT_UNIFORM_VECTORS),M=s.getParameter(s.MAX_SAMPLES),w=s.getParameter(s.SAMPLES);return{isWebGL2:!0,getMaxAnisotropy:r,getMaxPrecision:l,textureFormatReadable:o,textureTypeReadable:a,precision:c,logarithmicDepthBuffer:f,reversedDepthBuffer:u,maxTextures:d,maxVertexTextures:g,maxTextureSize:x,maxCubemapSize:p,maxAttributes:m,maxVertexUniforms:b,maxVaryings:T,maxFragmentUniforms:E,maxSamples:M,samples:w}}function b0(s){let e=this,t=null,n=0,i=!1,r=!1,o=new un,a=new Ne,l={value:null,needsUpdate:!1};this.uniform=l,this.numPlanes=0,this.numIntersection=0,this.init=function(u,f){let d=u.length!==0||f||n!==0||i;return i=f,n=u.length,d},this.beginShadows=function(){r=!0,h(null)},this.endShadows=function(){r=!1},this.setGlobalState=function(u,f){t=h(u,f,0)},this.setState=function(u,f,d){let g=u.clippingPlanes,x=u.clipIntersection,p=u.clipShadows,m=s.get(u);if(!i||g===null||g.length===0||r&&!p)r?h(null):c();else{let b=r?0:n,T=b*4,E=m.clippingState||null;l.value=E,E=h(g,f,T,d);for(let M=0;M!==T;++M)E[M]=t[M];m.clippingState=E,this.numIntersection=x?this.numPlanes:0,this.numPlanes+=b}};function c(){l.value!==t&&(l.value=t,l.needsUpdate=n>0),e.numPlanes=n,e.numIntersection=0}function h(u,f,d,g){let x=u!==null?u.length:0,p=null;if(x!==0){if(p=l.value,g!==!0||p===null){let m=d+x*4,b=f.matrixWorldInverse;a.getNormalMatrix(b),(p===null||p.length<m)&&(p=new Float32Array(m));for(let T=0,E=d;T!==x;++T,E+=4)o.copy(u[T]).applyMatrix4(b,a),o.normal.toArray(p,E),p[E+3]=o.constant}l.value=p,l.needsUpdate=!0}return e.numPlanes=x,e.numIntersection=0,p}}var lr=class extends $t{constructor(e=1,t={}){super(e,e,t),this.isWebGLCubeRenderTarget=!0;let n={width:e,height:e,depth:1},i=[n,n,n,n,n,n];this.texture=new Bs(i),this._setTextureOptions(t),this.texture.isRenderTargetTexture=!0}fromEquirectangularTexture(e,t){this.texture.type=t.type,this.texture.colorSpace=t.colorSpace,this.texture.generateMipmaps=t.generateMipmaps,this.texture.minFilter=t.minFilter,this.texture.magFilter=t.magFilter;let n={uniforms:{tEquirect:{value:null}},vertexShader:`

				varying vec3 vWorldDirection;

				vec3 transformDirection( in vec3 dir, in mat4 matrix ) {

					return normalize( ( matrix * vec4( dir, 0.0 ) ).xyz );

				}

				void main() {

					vWorldDirection = transformDirection( position, modelMatrix );

					#include <begin_vertex>
					#include <project_vertex>

				}
			`,fragmentShader:`

				uniform sampler2D tEquirect;

				varying vec3 vWorldDirection;

				#include <common>

				void main() {

					vec3 direction = normalize( vWorldDirection );

					vec2 sampleUV = equirectUv( direction );

					gl_FragColor = texture2D( tEquirect, sampleUV );

				}
			`},i=new ii(5,5,5),r=new Dt({name:"CubemapFromEquirect",uniforms:wi(n.uniforms),vertexShader:n.vertexShader,fragmentShader:n.fragmentShader,side:Ct,blending:_i});r.uniforms.tEquirect.value=t;let o=new ht(i,r),a=t.minFilter;return t.minFilter===Gn&&(t.minFilter=kt),new is(1,10,this).update(e,o),t.minFilter=a,o.geometry.dispose(),o.material.dispose(),this}clear(e,t=!0,n=!0,i=!0){let r=e.getRenderTarget();for(let o=0;o<6;o++)e.setRenderTarget(this,o),e.clear(t,n,i);e.setRenderTarget(r)}},Qu=256,M0=3,S0=20,Md=256,Sd=16,w0=3,E0=new U,A0=new Ie,Ua=class s{constructor(e){this._renderer=e,this._cubeSize=0,this._sourceTarget=null,this._cubeCamera=new is(1,10,null),this._boxMesh=new ht(new ii(5,5,5),null),this._cubemapMaterial=null,this._equirectMaterial=null,this._blurMaterial=null,this._ggxMaterial=null,this._integrationMaterial=null}fromScene(e,t=0,n=.1,i=100,r={}){let{size:o=256,position:a=E0}=r,l=this._renderer;this._setSize(o);let c=this._allocateTarget(),h=this._getSourceTarget(!0);t>0&&(h.texture.mipmapsAutoUpdate=!1);let u=l.autoClear,f=l.autoClearColor,d=l.autoClearDepth,g=l.autoClearStencil,x=e.background;l.autoClear=!0,l.autoClearColor=!0,l.autoClearDepth=!0,l.autoClearStencil=!0,x===null&&(e.background=l.getClearColor(A0));let p=new is(n,i,h);return p.position.copy(a),p.update(l,e),l.autoClear=u,l.autoClearColor=f,l.autoClearDepth=d,l.autoClearStencil=g,e.background=x,t>0&&(h.texture.mipmapsAutoUpdate=!0,this._blur(c,t)),this._applyPMREM(c),c}fromEquirectangular(e,t=null){return this._fromTexture(e,t)}fromCubemap(e,t=null){return this._fromTexture(e,t)}compileCubemapShader(){this._cubemapMaterial===null&&(this._cubemapMaterial=nd(),this._compileMaterial(this._cubemapMaterial))}compileEquirectangularShader(){this._equirectMaterial===null&&(this._equirectMaterial=td(),this._compileMaterial(this._equirectMaterial))}dispose(){this._sourceTarget!==null&&this._sourceTarget.dispose(),this._cubemapMaterial!==null&&this._cubemapMaterial.dispose(),this._equirectMaterial!==null&&this._equirectMaterial.dispose(),this._blurMaterial!==null&&this._blurMaterial.dispose(),this._ggxMaterial!==null&&this._ggxMaterial.dispose(),this._integrationMaterial!==null&&this._integrationMaterial.dispose(),this._boxMesh.geometry.dispose()}static lodToRoughness(e,t){return t>0?1-Math.sqrt(1-e/t):0}_setSize(e){this._cubeSize=Math.max(Qu,$u(e))}_fromTexture(e,t){e.mapping===Mi||e.mapping===os?this._setSize(e.image.length===0?Qu:e.image[0].width||e.image[0].image.width):this._setSize(e.image.width/4);let n=t||this._allocateTarget();return this._textureToCubemap(e),this._applyPMREM(n),n}_allocateTarget(){let e=this._cubeSize,t=ed(e,!1,!1),n=Math.log2(e)-M0;for(let i=0;i<=n;i++)t.texture.mipmaps.push({width:e>>i,height:e>>i});return t.texture.name="PMREM",t.texture.isPMREMTexture=!0,t}_getSourceTarget(e=!1){let t=this._cubeSize,n=this._sourceTarget;return(n===null||n.width!==t||e&&n.depthBuffer===!1)&&(n!==null&&n.dispose(),this._sourceTarget=ed(t,!0,e)),this._sourceTarget}_compileMaterial(e){this._boxMesh.material=e,this._renderer.compile(this._boxMesh,this._cubeCamera.children[0])}_renderCube(e,t,n){let i=this._boxMesh,r=this._cubeCamera;i.material=n,r.renderTarget=e,r.activeMipmapLevel=t;let o=e.width>>t;e.viewport.set(0,0,o,o),r.update(this._renderer,i),e.viewport.set(0,0,e.width,e.height)}_textureToCubemap(e){let t;e.mapping===Mi||e.mapping===os?(this._cubemapMaterial===null&&(this._cubemapMaterial=nd()),t=this._cubemapMaterial,t.uniforms.flipEnvMap.value=e.isRenderTargetTexture===!1?-1:1):(this._equirectMaterial===null&&(this._equirectMaterial=td()),t=this._equirectMaterial),t.uniforms.envMap.value=e,this._renderCube(this._getSourceTarget(),0,t)}_applyPMREM(e){this._ggxMaterial===null&&(this._ggxMaterial=T0(),this._integrationMaterial=R0());let t=this._cubeSize,n=e.texture.mipmaps.length-1,i=this._ggxMaterial.uniforms;i.envMap.value=this._sourceTarget.texture;let r=this._integrationMaterial.uniforms;r.envMap.value=this._sourceTarget.texture,r.sourceLod.value=Math.log2(t/Sd);for(let o=0;o<=n;o++){let a=s.lodToRoughness(o,n);if(o>n-w0)r.roughness.value=a,this._renderCube(e,o,this._integrationMaterial);else{let l=a>0?Math.log2(t)+.5*Math.log2(6/(Md*Math.pow(a,4)))+.5:0;i.roughness.value=a,i.lodBias.value=l,this._renderCube(e,o,this._ggxMaterial)}}}_blur(e,t){this._blurMaterial===null&&(this._blurMaterial=C0());let n=this._blurMaterial,i=n.uniforms,r=this._sourceTarget;i.sigma.value=Math.min(t,Math.PI)/Math.SQRT2,i.envMap.value=r.texture,this._renderCube(e,0,n),i.envMap.value=e.texture,this._renderCube(r,0,n)}};function ed(s,e,t){return new lr(s,{minFilter:Gn,generateMipmaps:e,type:pn,colorSpace:Rs,depthBuffer:t})}function cr(s,e,t){return new Dt({name:s,uniforms:e,vertexShader:Ve.cube_vert,fragmentShader:t,side:Ct,blending:_i,depthTest:!1,depthWrite:!1})}function T0(){return cr("PMREMGGXConvolution",{envMap:{value:null},roughness:{value:0},lodBias:{value:0}},`

		#define GGX_SAMPLES ${Md}u

		varying vec3 vWorldDirection;

		uniform samplerCube envMap;
		uniform float roughness;
		uniform float lodBias;

		#include <common>

		// Van der Corput radical inverse
		float radicalInverse_VdC( uint bits ) {

			bits = ( bits << 16u ) | ( bits >> 16u );
			bits = ( ( bits & 0x55555555u ) << 1u ) | ( ( bits & 0xAAAAAAAAu ) >> 1u );
			bits = ( ( bits & 0x33333333u ) << 2u ) | ( ( bits & 0xCCCCCCCCu ) >> 2u );
			bits = ( ( bits & 0x0F0F0F0Fu ) << 4u ) | ( ( bits & 0xF0F0F0F0u ) >> 4u );
			bits = ( ( bits & 0x00FF00FFu ) << 8u ) | ( ( bits & 0xFF00FF00u ) >> 8u );
			return float( bits ) * 2.3283064365386963e-10; // / 0x100000000

		}

		// Hammersley sequence
		vec2 hammersley( uint i, uint N ) {

			return vec2( float( i ) / float( N ), radicalInverse_VdC( i ) );

		}

		void main() {

			vec3 N = normalize( vWorldDirection );

			// For very low roughness, just sample the environment directly
			if ( roughness < 0.001 ) {

				gl_FragColor = vec4( textureLod( envMap, N, 0.0 ).rgb, 1.0 );
				return;

			}

			float alpha = roughness * roughness;
			float alpha2 = alpha * alpha;

			// Tangent space basis for VNDF sampling
			vec3 up = abs( N.z ) < 0.999 ? vec3( 0.0, 0.0, 1.0 ) : vec3( 1.0, 0.0, 0.0 );
			vec3 tangent = normalize( cross( up, N ) );
			vec3 bitangent = cross( N, tangent );

			vec3 prefilteredColor = vec3( 0.0 );
			float totalWeight = 0.0;

			for ( uint i = 0u; i < GGX_SAMPLES; i ++ ) {

				vec2 Xi = hammersley( i, GGX_SAMPLES );

				// With V = N, sample the reflected direction directly.
				float invQ = 1.0 / ( 1.0 - Xi.x + alpha2 * Xi.x );
				float NdotL = ( 1.0 - Xi.x - alpha2 * Xi.x ) * invQ;

				if ( NdotL > 0.0 ) {

					float phi = 2.0 * PI * Xi.y;
					float sinTheta = 2.0 * alpha * sqrt( Xi.x * ( 1.0 - Xi.x ) ) * invQ;
					vec3 L = N * NdotL + ( tangent * cos( phi ) + bitangent * sin( phi ) ) * sinTheta;

					// Match the source mip to the sample's solid angle. The terms
					// independent of the sample are precomputed in lodBias.
					float d = alpha2 * invQ;
					float lod = max( log2( d ) + lodBias, 0.0 );

					// Weight by NdotL for the split-sum approximation
					prefilteredColor += textureLod( envMap, L, lod ).rgb * NdotL;
					totalWeight += NdotL;

				}

			}

			gl_FragColor = vec4( prefilteredColor / totalWeight, 1.0 );

		}
	`)}function R0(){return cr("PMREMGGXIntegration",{envMap:{value:null},roughness:{value:0},sourceLod:{value:0},sourceSize:{value:Sd}},`

		varying vec3 vWorldDirection;

		uniform samplerCube envMap;
		uniform float roughness;
		uniform float sourceLod;
		uniform int sourceSize;

		void main() {

			vec3 N = normalize( vWorldDirection );

			float alpha = roughness * roughness;
			float alpha2 = alpha * alpha;

			float texelSize = 2.0 / float( sourceSize );

			vec3 prefilteredColor = vec3( 0.0 );
			float totalWeight = 0.0;

			// Pair opposite texels: only the one in N's hemisphere contributes.
			for ( int face = 0; face < 3; face ++ ) {

				for ( int y = 0; y < sourceSize; y ++ ) {

					for ( int x = 0; x < sourceSize; x ++ ) {

						vec2 uv = ( vec2( x, y ) + 0.5 ) * texelSize - 1.0;
						vec3 texelDirection = face == 0 ? vec3( 1.0, uv ) : ( face == 1 ? vec3( uv.x, 1.0, uv.y ) : vec3( uv, 1.0 ) );

						float invDistance = inversesqrt( 1.0 + dot( uv, uv ) );
						float NdotL = dot( N, texelDirection );
						texelDirection *= NdotL < 0.0 ? - 1.0 : 1.0;
						NdotL = abs( NdotL ) * invDistance;

						// With V = N, NdotH squared is ( 1 + NdotL ) / 2. Common factors
						// in the GGX distribution and texel solid angle cancel when normalized.
						float d = 1.0 + alpha2 + ( alpha2 - 1.0 ) * NdotL;
						float weight = NdotL * invDistance * invDistance * invDistance / ( d * d );

						prefilteredColor += textureLod( envMap, texelDirection, sourceLod ).rgb * weight;
						totalWeight += weight;

					}

				}

			}

			gl_FragColor = vec4( prefilteredColor / totalWeight, 1.0 );

		}
	`)}function C0(){return cr("PMREMSphericalGaussianBlur",{envMap:{value:null},sigma:{value:0}},`

		#define SAMPLES ${S0}
		#define GOLDEN_ANGLE 2.39996322973

		varying vec3 vWorldDirection;

		uniform samplerCube envMap;
		uniform float sigma;

		#include <common>

		void main() {

			vec3 outputDirection = normalize( vWorldDirection );

			vec3 up = abs( outputDirection.z ) < 0.999 ? vec3( 0.0, 0.0, 1.0 ) : vec3( 1.0, 0.0, 0.0 );
			vec3 tangent = normalize( cross( up, outputDirection ) );
			vec3 bitangent = cross( outputDirection, tangent );

			// Truncate the kernel at three standard deviations or at the antipode.
			float thetaMax = min( 3.0 * sigma, PI );
			float truncation = 1.0 - exp( - 0.5 * thetaMax * thetaMax / ( sigma * sigma ) );

			vec3 accumColor = vec3( 0.0 );
			float accumWeight = 0.0;

			for ( int i = 0; i < SAMPLES; i ++ ) {

				// Stratified inverse-CDF sampling of the Gaussian, placed on a golden-angle spiral.
				float stratum = ( float( i ) + 0.5 ) / float( SAMPLES );
				float theta = sigma * sqrt( - 2.0 * log( 1.0 - stratum * truncation ) );
				float phi = float( i ) * GOLDEN_ANGLE;

				vec3 offset = cos( phi ) * tangent + sin( phi ) * bitangent;
				vec3 sampleDirection = cos( theta ) * outputDirection + sin( theta ) * offset;

				// Correct the planar sample density to solid angle.
				float weight = sin( theta ) / theta;

				accumColor += weight * textureLod( envMap, sampleDirection, 0.0 ).rgb;
				accumWeight += weight;

			}

			gl_FragColor = vec4( accumColor / accumWeight, 1.0 );

		}
	`)}function td(){return cr("PMREMEquirectangularToCubemap",{envMap:{value:null}},`

		varying vec3 vWorldDirection;

		uniform sampler2D envMap;

		#include <common>

		void main() {

			// Average four subpixel samples to preserve small, bright features.
			vec3 direction = normalize( vWorldDirection );
			vec3 dx = dFdx( direction ) * 0.25;
			vec3 dy = dFdy( direction ) * 0.25;

			vec3 color = textureLod( envMap, equirectUv( normalize( direction - dx - dy ) ), 0.0 ).rgb;
			color += textureLod( envMap, equirectUv( normalize( direction + dx - dy ) ), 0.0 ).rgb;
			color += textureLod( envMap, equirectUv( normalize( direction - dx + dy ) ), 0.0 ).rgb;
			color += textureLod( envMap, equirectUv( normalize( direction + dx + dy ) ), 0.0 ).rgb;
			gl_FragColor = vec4( color * 0.25, 1.0 );

		}
	`)}function nd(){return cr("PMREMCubemapToCubemap",{envMap:{value:null},flipEnvMap:{value:-1}},`

		varying vec3 vWorldDirection;

		uniform samplerCube envMap;
		uniform float flipEnvMap;

		void main() {

			gl_FragColor = vec4( textureCube( envMap, vec3( flipEnvMap * vWorldDirection.x, vWorldDirection.yz ) ).rgb, 1.0 );

		}
	`)}function P0(s){let e=new WeakMap,t=new WeakMap,n=null;function i(f,d=!1){return f==null?null:d?o(f):r(f)}function r(f){if(f&&f.isTexture){let d=f.mapping;if(d===$o||d===Zo)if(e.has(f)){let g=e.get(f).texture;return a(g,f.mapping)}else{let g=f.image;if(g&&g.height>0){let x=new lr(g.height);return x.fromEquirectangularTexture(s,f),e.set(f,x),f.addEventListener("dispose",c),a(x.texture,f.mapping)}else return null}}return f}function o(f){if(f&&f.isTexture&&f.isPMREMTexture!==!0){let d=f.mapping,g=d===$o||d===Zo,x=d===Mi||d===os;if(g||x){let p=t.get(f),m=p!==void 0?p.texture.pmremVersion:0;if(f.isRenderTargetTexture&&f.pmremVersion!==m)return n===null&&(n=new Ua(s)),p=g?n.fromEquirectangular(f,p):n.fromCubemap(f,p),p.texture.pmremVersion=f.pmremVersion,t.set(f,p),p.texture;if(p!==void 0)return p.texture;{let b=f.image;return g&&b&&b.height>0||x&&b&&l(b)?(n===null&&(n=new Ua(s)),p=g?n.fromEquirectangular(f):n.fromCubemap(f),p.texture.pmremVersion=f.pmremVersion,t.set(f,p),f.addEventListener("dispose",h),p.texture):null}}}return f}function a(f,d){return d===$o?f.mapping=Mi:d===Zo&&(f.mapping=os),f}function l(f){let d=0,g=6;for(let x=0;x<g;x++)f[x]!==void 0&&d++;return d===g}function c(f){let d=f.target;d.removeEventListener("dispose",c);let g=e.get(d);g!==void 0&&(e.delete(d),g.dispose())}function h(f){let d=f.target;d.removeEventListener("dispose",h);let g=t.get(d);g!==void 0&&(t.delete(d),g.dispose())}function u(){e=new WeakMap,t=new WeakMap,n!==null&&(n.dispose(),n=null)}return{get:i,dispose:u}}function I0(s){let e={};function t(n){if(e[n]!==void 0)return e[n];let i=s.getExtension(n);return e[n]=i,i}return{has:function(n){return t(n)!==null},init:function(){t("EXT_color_buffer_float"),t("WEBGL_clip_cull_distance"),t("OES_texture_float_linear"),t("EXT_color_buffer_half_float"),t("WEBGL_multisampled_render_to_texture"),t("WEBGL_render_shared_exponent")},get:function(n){let i=t(n);return i===null&&As("WebGLRenderer: "+n+" extension not supported."),i}}}function L0(s,e,t,n){let i={},r=new WeakMap,o=new FinalizationRegistry(g=>delete i[g]);function a(g){l(g.target)}function l(g){g.index!==null&&e.remove(g.index);for(let p in g.attributes)e.remove(g.attributes[p]);g.removeEventListener("dispose",a),delete i[g.id],o.unregister(g);let x=r.get(g);x&&(e.remove(x),r.delete(g)),n.releaseStatesOfGeometry(g),g.isInstancedBufferGeometry===!0&&delete g._maxInstanceCount,t.memory.geometries--}function c(g,x){return i[x.id]!==void 0||(x.addEventListener("dispose",a),i[x.id]=new WeakRef(x),o.register(x,x.id,x),t.memory.geometries++),x}function h(g){let x=g.attributes;for(let p in x)e.update(x[p],s.ARRAY_BUFFER)}function u(g){let x=g.index,p=g.attributes.position,m=0;if(p===void 0)return;let b=x!==null?x.array.length:p.array.length/3-1,T=p.count>=65535?Fs:Ds,E=new T(Math.ceil(b/3)*6,1),M=E.array;if(x!==null){let y=x.array;m=x.version;for(let S=0,I=0;S<b;S+=3){let R=y[S+0],N=y[S+1],O=y[S+2];M[I++]=R,M[I++]=N,M[I++]=N,M[I++]=O,M[I++]=O,M[I++]=R}}else{m=p.version;for(let y=0,S=0;y<b;y+=3){let I=y+0,R=y+1,N=y+2;M[S++]=I,M[S++]=R,M[S++]=R,M[S++]=N,M[S++]=N,M[S++]=I}}E.version=m;let w=r.get(g);w&&e.remove(w),r.set(g,E)}function f(g){let x=r.get(g);if(x){let p=g.index;p!==null&&x.version<p.version&&u(g)}else u(g);return r.get(g)}function d(){for(let g in i){let x=i[g].deref();x!==void 0&&l(x)}}return{get:c,update:h,getWireframeAttribute:f,dispose:d}}function N0(s,e,t){let n;function i(u){n=u}let r,o;function a(u){r=u.type,o=u.bytesPerElement}function l(u,f){s.drawElements(n,f,r,u*o),t.update(f,n,1)}function c(u,f,d){d!==0&&(s.drawElementsInstanced(n,f,r,u*o,d),t.update(f,n,d))}function h(u,f,d){if(d===0)return;e.get("WEBGL_multi_draw").multiDrawElementsWEBGL(n,f,0,r,u,0,d);let x=0;for(let p=0;p<d;p++)x+=f[p];t.update(x,n,1)}this.setMode=i,this.setIndex=a,this.render=l,this.renderInstances=c,this.renderMultiDraw=h}function D0(s){let e={geometries:0,textures:0},t={frame:0,calls:0,triangles:0,points:0,lines:0};function n(r,o,a){switch(t.calls++,o){case s.TRIANGLES:t.triangles+=a*(r/3);break;case s.LINES:t.lines+=a*(r/2);break;case s.LINE_STRIP:t.lines+=a*(r-1);break;case s.LINE_LOOP:t.lines+=a*r;break;case s.POINTS:t.points+=a*r;break;default:Le("WebGLInfo: Unknown draw mode:",o);break}}function i(){t.calls=0,t.triangles=0,t.points=0,t.lines=0}return{memory:e,render:t,programs:null,autoReset:!0,reset:i,update:n}}function F0(s,e,t){let n=new WeakMap,i=new at;function r(o,a,l){let c=o.morphTargetInfluences,h=a.morphAttributes.position||a.morphAttributes.normal||a.morphAttributes.color,u=h!==void 0?h.length:0,f=n.get(a);if(f===void 0||f.count!==u){let I=function(){y.dispose(),n.delete(a),a.removeEventListener("dispose",I)};f!==void 0&&f.texture.dispose();let d=a.morphAttributes.position!==void 0,g=a.morphAttributes.normal!==void 0,x=a.morphAttributes.color!==void 0,p=a.morphAttributes.position||[],m=a.morphAttributes.normal||[],b=a.morphAttributes.color||[],T=0;d===!0&&(T=1),g===!0&&(T=2),x===!0&&(T=3);let E=a.attributes.position.count*T,M=1;E>e.maxTextureSize&&(M=Math.ceil(E/e.maxTextureSize),E=e.maxTextureSize);let w=new Float32Array(E*M*4*u),y=new Is(w,E,M,u);y.type=fn,y.needsUpdate=!0;let S=T*4;for(let R=0;R<u;R++){let N=p[R],O=m[R],D=b[R],P=E*M*4*R;for(let V=0;V<N.count;V++){let W=V*S;d===!0&&(i.fromBufferAttribute(N,V),w[P+W+0]=i.x,w[P+W+1]=i.y,w[P+W+2]=i.z,w[P+W+3]=0),g===!0&&(i.fromBufferAttribute(O,V),w[P+W+4]=i.x,w[P+W+5]=i.y,w[P+W+6]=i.z,w[P+W+7]=0),x===!0&&(i.fromBufferAttribute(D,V),w[P+W+8]=i.x,w[P+W+9]=i.y,w[P+W+10]=i.z,w[P+W+11]=D.itemSize===4?i.w:1)}}f={count:u,texture:y,size:new Be(E,M)},n.set(a,f),a.addEventListener("dispose",I)}if(o.isInstancedMesh===!0&&o.morphTexture!==null)l.getUniforms().setValue(s,"morphTexture",o.morphTexture,t);else{let d=0;for(let x=0;x<c.length;x++)d+=c[x];let g=a.morphTargetsRelative?1:1-d;l.getUniforms().setValue(s,"morphTargetBaseInfluence",g),l.getUniforms().setValue(s,"morphTargetInfluences",c)}l.getUniforms().setValue(s,"morphTargetsTexture",f.texture,t),l.getUniforms().setValue(s,"morphTargetsTextureSize",f.size)}return{update:r}}function U0(s,e,t,n,i){let r=new WeakMap;function o(c){let h=i.render.frame,u=c.geometry,f=e.get(c,u);if(r.get(f)!==h&&(e.update(f),r.set(f,h)),c.isInstancedMesh&&(c.hasEventListener("dispose",l)===!1&&c.addEventListener("dispose",l),r.get(c)!==h&&(t.update(c.instanceMatrix,s.ARRAY_BUFFER),c.instanceColor!==null&&t.update(c.instanceColor,s.ARRAY_BUFFER),r.set(c,h))),c.isSkinnedMesh){let d=c.skeleton;r.get(d)!==h&&(d.update(),r.set(d,h))}return f}function a(){r=new WeakMap}function l(c){let h=c.target;h.removeEventListener("dispose",l),n.releaseStatesOfObject(h),t.remove(h.instanceMatrix),h.instanceColor!==null&&t.remove(h.instanceColor)}return{update:o,dispose:a}}var O0={[fc]:"LINEAR_TONE_MAPPING",[pc]:"REINHARD_TONE_MAPPING",[mc]:"CINEON_TONE_MAPPING",[gc]:"ACES_FILMIC_TONE_MAPPING",[xc]:"AGX_TONE_MAPPING",[vc]:"NEUTRAL_TONE_MAPPING",[yc]:"CUSTOM_TONE_MAPPING"};function B0(s,e,t,n,i,r){let o=new $t(e,t,{type:s,depthBuffer:i,stencilBuffer:r,samples:n?4:0,storeMultisampledDepthBuffer:!1,storeMultisampledStencilBuffer:!1,resolveDepthBuffer:!1,resolveStencilBuffer:!1}),a=null,l=null,c=null,h=new Et;h.setAttribute("position",new nt([-1,3,0,-1,-1,0,3,-1,0],3)),h.setAttribute("uv",new nt([0,2,0,0,2,0],2));let u=new Lo({uniforms:{tDiffuse:{value:null}},vertexShader:`
			precision highp float;

			uniform mat4 modelViewMatrix;
			uniform mat4 projectionMatrix;

			attribute vec3 position;
			attribute vec2 uv;

			varying vec2 vUv;

			void main() {
				vUv = uv;
				gl_Position = projectionMatrix * modelViewMatrix * vec4( position, 1.0 );
			}`,fragmentShader:`
			precision highp float;

			uniform sampler2D tDiffuse;

			varying vec2 vUv;

			#include <tonemapping_pars_fragment>
			#include <colorspace_pars_fragment>

			void main() {
				gl_FragColor = texture2D( tDiffuse, vUv );

				#ifdef LINEAR_TONE_MAPPING
					gl_FragColor.rgb = LinearToneMapping( gl_FragColor.rgb );
				#elif defined( REINHARD_TONE_MAPPING )
					gl_FragColor.rgb = ReinhardToneMapping( gl_FragColor.rgb );
				#elif defined( CINEON_TONE_MAPPING )
					gl_FragColor.rgb = CineonToneMapping( gl_FragColor.rgb );
				#elif defined( ACES_FILMIC_TONE_MAPPING )
					gl_FragColor.rgb = ACESFilmicToneMapping( gl_FragColor.rgb );
				#elif defined( AGX_TONE_MAPPING )
					gl_FragColor.rgb = AgXToneMapping( gl_FragColor.rgb );
				#elif defined( NEUTRAL_TONE_MAPPING )
					gl_FragColor.rgb = NeutralToneMapping( gl_FragColor.rgb );
				#elif defined( CUSTOM_TONE_MAPPING )
					gl_FragColor.rgb = CustomToneMapping( gl_FragColor.rgb );
				#endif

				#ifdef SRGB_TRANSFER
					gl_FragColor = sRGBTransferOETF( gl_FragColor );
				#endif
			}`,depthTest:!1,depthWrite:!1}),f=new ht(h,u),d=new $s(-1,1,1,-1,0,1),g=null,x=null,p=!1,m,b=null,T=[],E=!1;this.setSize=function(M,w){o.setSize(M,w),a!==null&&a.setSize(M,w),l!==null&&l.setSize(M,w);for(let y=0;y<T.length;y++){let S=T[y];S.setSize&&S.setSize(M,w)}},this.setEffects=function(M){T=M,E=T.length>0&&T[0].isRenderPass===!0;let w=o.width,y=o.height;T.length>0&&a===null&&(a=new $t(w,y,{type:pn,depthBuffer:!1,stencilBuffer:!1}),l=new $t(w,y,{type:pn,depthBuffer:!1,stencilBuffer:!1}));let S=i===!0&&T.some(I=>I.needsDepthTexture===!0);S!==(o.depthTexture!==null)&&(S===!0&&c===null&&(c=new zn(w,y),r===!0&&(c.format=Hn,c.type=Si)),o.dispose(),o.depthTexture=S?c:null,o.resolveDepthBuffer=S,o.storeMultisampledDepthBuffer=S);for(let I=0;I<T.length;I++){let R=T[I];R.setSize&&R.setSize(w,y),S&&R.needsDepthTexture===!0&&R.setDepthTexture&&R.setDepthTexture(c)}},this.begin=function(M,w){if(p||M.toneMapping===wn&&T.length===0)return!1;if(b=w,w!==null){let y=w.width,S=w.height;(o.width!==y||o.height!==S)&&this.setSize(y,S)}return E===!1&&M.setRenderTarget(o),m=M.toneMapping,M.toneMapping=wn,!0},this.hasRenderPass=function(){return E},this.end=function(M,w){M.toneMapping=m,p=!0;let y=o,S=a;for(let I=0;I<T.length;I++){let R=T[I];R.enabled!==!1&&(R.render(M,S,y,w),R.needsSwap!==!1&&(y=S,S=S===a?l:a))}if(g!==M.outputColorSpace||x!==M.toneMapping){g=M.outputColorSpace,x=M.toneMapping,u.defines={},Xe.getTransfer(g)===Ze&&(u.defines.SRGB_TRANSFER="");let I=O0[x];I&&(u.defines[I]=""),u.needsUpdate=!0}u.uniforms.tDiffuse.value=y.texture,M.setRenderTarget(b),M.render(f,d),b=null,p=!1},this.isCompositing=function(){return p},this.dispose=function(){o.dispose(),a!==null&&a.dispose(),l!==null&&l.dispose(),h.dispose(),u.dispose()}}var wd=new Vt,Ed=new zn(1,1),Ad=new ks(1),Td=new Is,Rd=new Ao,Cd=new Bs,id=[],sd=[],rd=new Float32Array(16),od=new Float32Array(9),ad=new Float32Array(4);function cs(s,e,t){let n=s[0];if(n<=0||n>0)return s;let i=e*t,r=id[i];if(r===void 0&&(r=new Float32Array(i),id[i]=r),e!==0){n.toArray(r,0);for(let o=1,a=0;o!==e;++o)a+=t,s[o].toArray(r,a)}return r}function yt(s,e){if(s.length!==e.length)return!1;for(let t=0,n=s.length;t<n;t++)if(s[t]!==e[t])return!1;return!0}function xt(s,e){for(let t=0,n=e.length;t<n;t++)s[t]=e[t]}function Ba(s,e){let t=sd[e];t===void 0&&(t=new Int32Array(e),sd[e]=t);for(let n=0;n!==e;++n)t[n]=s.allocateTextureUnit();return t}function k0(s,e){let t=this.cache;t[0]!==e&&(s.uniform1f(this.addr,e),t[0]=e)}function z0(s,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y)&&(s.uniform2f(this.addr,e.x,e.y),t[0]=e.x,t[1]=e.y);else{if(yt(t,e))return;s.uniform2fv(this.addr,e),xt(t,e)}}function V0(s,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y||t[2]!==e.z)&&(s.uniform3f(this.addr,e.x,e.y,e.z),t[0]=e.x,t[1]=e.y,t[2]=e.z);else if(e.r!==void 0)(t[0]!==e.r||t[1]!==e.g||t[2]!==e.b)&&(s.uniform3f(this.addr,e.r,e.g,e.b),t[0]=e.r,t[1]=e.g,t[2]=e.b);else{if(yt(t,e))return;s.uniform3fv(this.addr,e),xt(t,e)}}function G0(s,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y||t[2]!==e.z||t[3]!==e.w)&&(s.uniform4f(this.addr,e.x,e.y,e.z,e.w),t[0]=e.x,t[1]=e.y,t[2]=e.z,t[3]=e.w);else{if(yt(t,e))return;s.uniform4fv(this.addr,e),xt(t,e)}}function H0(s,e){let t=this.cache,n=e.elements;if(n===void 0){if(yt(t,e))return;s.uniformMatrix2fv(this.addr,!1,e),xt(t,e)}else{if(yt(t,n))return;ad.set(n),s.uniformMatrix2fv(this.addr,!1,ad),xt(t,n)}}function W0(s,e){let t=this.cache,n=e.elements;if(n===void 0){if(yt(t,e))return;s.uniformMatrix3fv(this.addr,!1,e),xt(t,e)}else{if(yt(t,n))return;od.set(n),s.uniformMatrix3fv(this.addr,!1,od),xt(t,n)}}function X0(s,e){let t=this.cache,n=e.elements;if(n===void 0){if(yt(t,e))return;s.uniformMatrix4fv(this.addr,!1,e),xt(t,e)}else{if(yt(t,n))return;rd.set(n),s.uniformMatrix4fv(this.addr,!1,rd),xt(t,n)}}function q0(s,e){let t=this.cache;t[0]!==e&&(s.uniform1i(this.addr,e),t[0]=e)}function Y0(s,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y)&&(s.uniform2i(this.addr,e.x,e.y),t[0]=e.x,t[1]=e.y);else{if(yt(t,e))return;s.uniform2iv(this.addr,e),xt(t,e)}}function $0(s,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y||t[2]!==e.z)&&(s.uniform3i(this.addr,e.x,e.y,e.z),t[0]=e.x,t[1]=e.y,t[2]=e.z);else{if(yt(t,e))return;s.uniform3iv(this.addr,e),xt(t,e)}}function Z0(s,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y||t[2]!==e.z||t[3]!==e.w)&&(s.uniform4i(this.addr,e.x,e.y,e.z,e.w),t[0]=e.x,t[1]=e.y,t[2]=e.z,t[3]=e.w);else{if(yt(t,e))return;s.uniform4iv(this.addr,e),xt(t,e)}}function J0(s,e){let t=this.cache;t[0]!==e&&(s.uniform1ui(this.addr,e),t[0]=e)}function K0(s,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y)&&(s.uniform2ui(this.addr,e.x,e.y),t[0]=e.x,t[1]=e.y);else{if(yt(t,e))return;s.uniform2uiv(this.addr,e),xt(t,e)}}function j0(s,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y||t[2]!==e.z)&&(s.uniform3ui(this.addr,e.x,e.y,e.z),t[0]=e.x,t[1]=e.y,t[2]=e.z);else{if(yt(t,e))return;s.uniform3uiv(this.addr,e),xt(t,e)}}function Q0(s,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y||t[2]!==e.z||t[3]!==e.w)&&(s.uniform4ui(this.addr,e.x,e.y,e.z,e.w),t[0]=e.x,t[1]=e.y,t[2]=e.z,t[3]=e.w);else{if(yt(t,e))return;s.uniform4uiv(this.addr,e),xt(t,e)}}function ka(s){return s.version===0&&(s.compareFunction=Pc,s.needsUpdate=!0),s}function ey(s,e,t){let n=this.cache,i=t.allocateTextureUnit();n[0]!==i&&(s.uniform1i(this.addr,i),n[0]=i);let r;this.type===s.SAMPLER_2D_SHADOW?r=ka(Ed):r=wd,t.setTexture2D(e||r,i)}function ty(s,e,t){let n=this.cache,i=t.allocateTextureUnit();n[0]!==i&&(s.uniform1i(this.addr,i),n[0]=i),t.setTexture3D(e||Rd,i)}function ny(s,e,t){let n=this.cache,i=t.allocateTextureUnit();n[0]!==i&&(s.uniform1i(this.addr,i),n[0]=i);let r;this.type===s.SAMPLER_CUBE_SHADOW?r=ka(Ad):r=Cd,t.setTextureCube(e||r,i)}function iy(s,e,t){let n=this.cache,i=t.allocateTextureUnit();n[0]!==i&&(s.uniform1i(this.addr,i),n[0]=i),t.setTexture2DArray(e||Td,i)}function sy(s){switch(s){case 5126:return k0;case 35664:return z0;case 35665:return V0;case 35666:return G0;case 35674:return H0;case 35675:return W0;case 35676:return X0;case 5124:case 35670:return q0;case 35667:case 35671:return Y0;case 35668:case 35672:return $0;case 35669:case 35673:return Z0;case 5125:return J0;case 36294:return K0;case 36295:return j0;case 36296:return Q0;case 35678:case 36198:case 36298:case 36306:case 35682:return ey;case 35679:case 36299:case 36307:return ty;case 35680:case 36300:case 36308:case 36293:return ny;case 36289:case 36303:case 36311:case 36292:return iy}}function ry(s,e){s.uniform1fv(this.addr,e)}function oy(s,e){let t=cs(e,this.size,2);s.uniform2fv(this.addr,t)}function ay(s,e){let t=cs(e,this.size,3);s.uniform3fv(this.addr,t)}function ly(s,e){let t=cs(e,this.size,4);s.uniform4fv(this.addr,t)}function cy(s,e){let t=cs(e,this.size,4);s.uniformMatrix2fv(this.addr,!1,t)}function hy(s,e){let t=cs(e,this.size,9);s.uniformMatrix3fv(this.addr,!1,t)}function uy(s,e){let t=cs(e,this.size,16);s.uniformMatrix4fv(this.addr,!1,t)}function dy(s,e){s.uniform1iv(this.addr,e)}function fy(s,e){s.uniform2iv(this.addr,e)}function py(s,e){s.uniform3iv(this.addr,e)}function my(s,e){s.uniform4iv(this.addr,e)}function gy(s,e){s.uniform1uiv(this.addr,e)}function yy(s,e){s.uniform2uiv(this.addr,e)}function xy(s,e){s.uniform3uiv(this.addr,e)}function vy(s,e){s.uniform4uiv(this.addr,e)}function _y(s,e,t){let n=this.cache,i=e.length,r=Ba(t,i);yt(n,r)||(s.uniform1iv(this.addr,r),xt(n,r));let o;this.type===s.SAMPLER_2D_SHADOW?o=ka(Ed):o=wd;for(let a=0;a!==i;++a)t.setTexture2D(e[a]||o,r[a])}function by(s,e,t){let n=this.cache,i=e.length,r=Ba(t,i);yt(n,r)||(s.uniform1iv(this.addr,r),xt(n,r));for(let o=0;o!==i;++o)t.setTexture3D(e[o]||Rd,r[o])}function My(s,e,t){let n=this.cache,i=e.length,r=Ba(t,i);yt(n,r)||(s.uniform1iv(this.addr,r),xt(n,r));let o;this.type===s.SAMPLER_CUBE_SHADOW?o=ka(Ad):o=Cd;for(let a=0;a!==i;++a)t.setTextureCube(e[a]||o,r[a])}function Sy(s,e,t){let n=this.cache,i=e.length,r=Ba(t,i);yt(n,r)||(s.uniform1iv(this.addr,r),xt(n,r));for(let o=0;o!==i;++o)t.setTexture2DArray(e[o]||Td,r[o])}function wy(s){switch(s){case 5126:return ry;case 35664:return oy;case 35665:return ay;case 35666:return ly;case 35674:return cy;case 35675:return hy;case 35676:return uy;case 5124:case 35670:return dy;case 35667:case 35671:return fy;case 35668:case 35672:return py;case 35669:case 35673:return my;case 5125:return gy;case 36294:return yy;case 36295:return xy;case 36296:return vy;case 35678:case 36198:case 36298:case 36306:case 35682:return _y;case 35679:case 36299:case 36307:return by;case 35680:case 36300:case 36308:case 36293:return My;case 36289:case 36303:case 36311:case 36292:return Sy}}var zc=class{constructor(e,t,n){this.id=e,this.addr=n,this.cache=[],this.type=t.type,this.setValue=sy(t.type)}},Vc=class{constructor(e,t,n){this.id=e,this.addr=n,this.cache=[],this.type=t.type,this.size=t.size,this.setValue=wy(t.type)}},Gc=class{constructor(e){this.id=e,this.seq=[],this.map={}}setValue(e,t,n){let i=this.seq;for(let r=0,o=i.length;r!==o;++r){let a=i[r];a.setValue(e,t[a.id],n)}}},Bc=/(\w+)(\])?(\[|\.)?/g;function ld(s,e){s.seq.push(e),s.map[e.id]=e}function Ey(s,e,t){let n=s.name,i=n.length;for(Bc.lastIndex=0;;){let r=Bc.exec(n),o=Bc.lastIndex,a=r[1],l=r[2]==="]",c=r[3];if(l&&(a=a|0),c===void 0||c==="["&&o+2===i){ld(t,c===void 0?new zc(a,s,e):new Vc(a,s,e));break}else{let u=t.map[a];u===void 0&&(u=new Gc(a),ld(t,u)),t=u}}}var ls=class{constructor(e,t){this.seq=[],this.map={};let n=e.getProgramParameter(t,e.ACTIVE_UNIFORMS);for(let o=0;o<n;++o){let a=e.getActiveUniform(t,o),l=e.getUniformLocation(t,a.name);Ey(a,l,this)}let i=[],r=[];for(let o of this.seq)o.type===e.SAMPLER_2D_SHADOW||o.type===e.SAMPLER_CUBE_SHADOW||o.type===e.SAMPLER_2D_ARRAY_SHADOW?i.push(o):r.push(o);i.length>0&&(this.seq=i.concat(r))}setValue(e,t,n,i){let r=this.map[t];r!==void 0&&r.setValue(e,n,i)}setOptional(e,t,n){let i=t[n];i!==void 0&&this.setValue(e,n,i)}static upload(e,t,n,i){for(let r=0,o=t.length;r!==o;++r){let a=t[r],l=n[a.id];l.needsUpdate!==!1&&a.setValue(e,l.value,i)}}static seqWithValue(e,t){let n=[];for(let i=0,r=e.length;i!==r;++i){let o=e[i];o.id in t&&n.push(o)}return n}};function cd(s,e,t){let n=s.createShader(e);return s.shaderSource(n,t),s.compileShader(n),n}var Ay=37297,Ty=0;function Ry(s,e){let t=s.split(`
`),n=[],i=Math.max(e-6,0),r=Math.min(e+6,t.length);for(let o=i;o<r;o++){let a=o+1;n.push(`${a===e?">":" "} ${a}: ${t[o]}`)}return n.join(`
`)}var hd=new Ne;function Cy(s){Xe._getMatrix(hd,Xe.workingColorSpace,s);let e=`mat3( ${hd.elements.map(t=>t.toFixed(4))} )`;switch(Xe.getTransfer(s)){case Cs:return[e,"LinearTransferOETF"];case Ze:return[e,"sRGBTransferOETF"];default:return Ce("WebGLProgram: Unsupported color space: ",s),[e,"LinearTransferOETF"]}}function ud(s,e,t){let n=s.getShaderParameter(e,s.COMPILE_STATUS),r=(s.getShaderInfoLog(e)||"").trim();if(n&&r==="")return"";let o=/ERROR: 0:(\d+)/.exec(r);if(o){let a=parseInt(o[1]);return t.toUpperCase()+`

`+r+`

`+Ry(s.getShaderSource(e),a)}else return r}function Py(s,e){let t=Cy(e);return[`vec4 ${s}( vec4 value ) {`,`	return ${t[1]}( vec4( ${t[0]} * value.rgb, value.a ) );`,"}"].join(`
`)}var Iy={[fc]:"Linear",[pc]:"Reinhard",[mc]:"Cineon",[gc]:"ACESFilmic",[xc]:"AgX",[vc]:"Neutral",[yc]:"Custom"};function Ly(s,e){let t=Iy[e];return t===void 0?(Ce("WebGLProgram: Unsupported toneMapping:",e),"vec3 "+s+"( vec3 color ) { return LinearToneMapping( color ); }"):"vec3 "+s+"( vec3 color ) { return "+t+"ToneMapping( color ); }"}var Fa=new U;function Ny(){Xe.getLuminanceCoefficients(Fa);let s=Fa.x.toFixed(4),e=Fa.y.toFixed(4),t=Fa.z.toFixed(4);return["float luminance( const in vec3 rgb ) {",`	const vec3 weights = vec3( ${s}, ${e}, ${t} );`,"	return dot( weights, rgb );","}"].join(`
`)}function Dy(s){return[s.extensionClipCullDistance?"#extension GL_ANGLE_clip_cull_distance : require":"",s.extensionMultiDraw?"#extension GL_ANGLE_multi_draw : require":""].filter(ar).join(`
`)}function Fy(s){let e=[];for(let t in s){let n=s[t];n!==!1&&e.push("#define "+t+" "+n)}return e.join(`
`)}function Uy(s,e){let t={},n=s.getProgramParameter(e,s.ACTIVE_ATTRIBUTES);for(let i=0;i<n;i++){let r=s.getActiveAttrib(e,i),o=r.name,a=1;r.type===s.FLOAT_MAT2&&(a=2),r.type===s.FLOAT_MAT3&&(a=3),r.type===s.FLOAT_MAT4&&(a=4),t[o]={type:r.type,location:s.getAttribLocation(e,o),locationSize:a}}return t}function ar(s){return s!==""}function dd(s,e){let t=e.numSpotLightShadows+e.numSpotLightMaps-e.numSpotLightShadowsWithMaps;return s.replace(/NUM_SUN_LIGHTS/g,e.numSunLights).replace(/NUM_DIR_LIGHTS/g,e.numDirLights).replace(/NUM_SPOT_LIGHTS/g,e.numSpotLights).replace(/NUM_SPOT_LIGHT_MAPS/g,e.numSpotLightMaps).replace(/NUM_SPOT_LIGHT_COORDS/g,t).replace(/NUM_RECT_AREA_LIGHTS/g,e.numRectAreaLights).replace(/NUM_POINT_LIGHTS/g,e.numPointLights).replace(/NUM_HEMI_LIGHTS/g,e.numHemiLights).replace(/NUM_SUN_LIGHT_SHADOWS/g,e.numSunLightShadows).replace(/NUM_DIR_LIGHT_SHADOWS/g,e.numDirLightShadows).replace(/NUM_SPOT_LIGHT_SHADOWS_WITH_MAPS/g,e.numSpotLightShadowsWithMaps).replace(/NUM_SPOT_LIGHT_SHADOWS/g,e.numSpotLightShadows).replace(/NUM_POINT_LIGHT_SHADOWS/g,e.numPointLightShadows).replace(/NUM_LIGHT_PROBE_GRIDS/g,e.numLightProbeGrids)}function fd(s,e){return s.replace(/NUM_CLIPPING_PLANES/g,e.numClippingPlanes).replace(/UNION_CLIPPING_PLANES/g,e.numClippingPlanes-e.numClipIntersection)}var Oy=/^[ \t]*#include +<([\w\d./]+)>/gm;function Hc(s){return s.replace(Oy,By)}function By(s,e){let t=Ve[e];if(t===void 0)throw new Error("THREE.WebGLProgram: Can not resolve #include <"+e+">");return Hc(t)}var ky=/#pragma unroll_loop_start\s+for\s*\(\s*int\s+i\s*=\s*(\d+)\s*;\s*i\s*<\s*(\d+)\s*;\s*i\s*\+\+\s*\)\s*{([\s\S]+?)}\s+#pragma unroll_loop_end/g;function pd(s){return s.replace(ky,zy)}function zy(s,e,t,n){let i="";for(let r=parseInt(e);r<parseInt(t);r++)i+=n.replace(/\[\s*i\s*\]/g,"[ "+r+" ]").replace(/UNROLLED_LOOP_INDEX/g,r);return i}function md(s){let e=`precision ${s.precision} float;
	precision ${s.precision} int;
	precision ${s.precision} sampler2D;
	precision ${s.precision} samplerCube;
	precision ${s.precision} sampler3D;
	precision ${s.precision} sampler2DArray;
	precision ${s.precision} sampler2DShadow;
	precision ${s.precision} samplerCubeShadow;
	precision ${s.precision} sampler2DArrayShadow;
	precision ${s.precision} isampler2D;
	precision ${s.precision} isampler3D;
	precision ${s.precision} isamplerCube;
	precision ${s.precision} isampler2DArray;
	precision ${s.precision} usampler2D;
	precision ${s.precision} usampler3D;
	precision ${s.precision} usamplerCube;
	precision ${s.precision} usampler2DArray;
	`;return s.precision==="highp"?e+=`
#define HIGH_PRECISION`:s.precision==="mediump"?e+=`
#define MEDIUM_PRECISION`:s.precision==="lowp"&&(e+=`
#define LOW_PRECISION`),e}var Vy={[vi]:"SHADOWMAP_TYPE_PCF",[ss]:"SHADOWMAP_TYPE_VSM"};function Gy(s){return Vy[s.shadowMapType]||"SHADOWMAP_TYPE_BASIC"}var Hy={[os]:"ENVMAP_MODE_REFRACTION"};function Wy(s){return s.envMap===!1?"ENVMAP_MODE_REFLECTION":Hy[s.envMapMode]||"ENVMAP_MODE_REFLECTION"}var Xy={[Yo]:"ENVMAP_BLENDING_MULTIPLY",[Lu]:"ENVMAP_BLENDING_MIX",[Nu]:"ENVMAP_BLENDING_ADD"};function qy(s){return s.envMap===!1?"ENVMAP_BLENDING_NONE":Xy[s.combine]||"ENVMAP_BLENDING_NONE"}function Yy(s,e,t,n){let i=s.getContext(),r=t.defines,o=t.vertexShader,a=t.fragmentShader,l=Gy(t),c=t.envMapPMREM===!0?"ENVMAP_TYPE_PMREM":"ENVMAP_TYPE_CUBE",h=Wy(t),u=qy(t),f=Dy(t),d=Fy(r),g=i.createProgram(),x,p,m=t.glslVersion?"#version "+t.glslVersion+`
`:"";t.isRawShaderMaterial?(x=["#define SHADER_TYPE "+t.shaderType,"#define SHADER_NAME "+t.shaderName,d].filter(ar).join(`
`),x.length>0&&(x+=`
`),p=["#define SHADER_TYPE "+t.shaderType,"#define SHADER_NAME "+t.shaderName,d].filter(ar).join(`
`),p.length>0&&(p+=`
`)):(x=[md(t),"#define SHADER_TYPE "+t.shaderType,"#define SHADER_NAME "+t.shaderName,d,t.extensionClipCullDistance?"#define USE_CLIP_DISTANCE":"",t.batching?"#define USE_BATCHING":"",t.batchingColor?"#define USE_BATCHING_COLOR":"",t.instancing?"#define USE_INSTANCING":"",t.instancingColor?"#define USE_INSTANCING_COLOR":"",t.instancingMorph?"#define USE_INSTANCING_MORPH":"",t.useFog&&t.fog?"#define USE_FOG":"",t.useFog&&t.fogExp2?"#define FOG_EXP2":"",t.map?"#define USE_MAP":"",t.envMap?"#define USE_ENVMAP":"",t.envMap?"#define "+h:"",t.lightMap?"#define USE_LIGHTMAP":"",t.aoMap?"#define USE_AOMAP":"",t.bumpMap?"#define USE_BUMPMAP":"",t.normalMap?"#define USE_NORMALMAP":"",t.normalMapObjectSpace?"#define USE_NORMALMAP_OBJECTSPACE":"",t.normalMapTangentSpace?"#define USE_NORMALMAP_TANGENTSPACE":"",t.displacementMap?"#define USE_DISPLACEMENTMAP":"",t.emissiveMap?"#define USE_EMISSIVEMAP":"",t.anisotropy?"#define USE_ANISOTROPY":"",t.anisotropyMap?"#define USE_ANISOTROPYMAP":"",t.clearcoatMap?"#define USE_CLEARCOATMAP":"",t.clearcoatRoughnessMap?"#define USE_CLEARCOAT_ROUGHNESSMAP":"",t.clearcoatNormalMap?"#define USE_CLEARCOAT_NORMALMAP":"",t.diffuseRoughnessMap?"#define USE_DIFFUSE_ROUGHNESSMAP":"",t.iridescenceMap?"#define USE_IRIDESCENCEMAP":"",t.iridescenceThicknessMap?"#define USE_IRIDESCENCE_THICKNESSMAP":"",t.specularMap?"#define USE_SPECULARMAP":"",t.specularColorMap?"#define USE_SPECULAR_COLORMAP":"",t.specularIntensityMap?"#define USE_SPECULAR_INTENSITYMAP":"",t.roughnessMap?"#define USE_ROUGHNESSMAP":"",t.metalnessMap?"#define USE_METALNESSMAP":"",t.alphaMap?"#define USE_ALPHAMAP":"",t.alphaHash?"#define USE_ALPHAHASH":"",t.transmission?"#define USE_TRANSMISSION":"",t.transmissionMap?"#define USE_TRANSMISSIONMAP":"",t.thicknessMap?"#define USE_THICKNESSMAP":"",t.sheenColorMap?"#define USE_SHEEN_COLORMAP":"",t.sheenRoughnessMap?"#define USE_SHEEN_ROUGHNESSMAP":"",t.mapUv?"#define MAP_UV "+t.mapUv:"",t.alphaMapUv?"#define ALPHAMAP_UV "+t.alphaMapUv:"",t.lightMapUv?"#define LIGHTMAP_UV "+t.lightMapUv:"",t.aoMapUv?"#define AOMAP_UV "+t.aoMapUv:"",t.emissiveMapUv?"#define EMISSIVEMAP_UV "+t.emissiveMapUv:"",t.bumpMapUv?"#define BUMPMAP_UV "+t.bumpMapUv:"",t.normalMapUv?"#define NORMALMAP_UV "+t.normalMapUv:"",t.displacementMapUv?"#define DISPLACEMENTMAP_UV "+t.displacementMapUv:"",t.metalnessMapUv?"#define METALNESSMAP_UV "+t.metalnessMapUv:"",t.roughnessMapUv?"#define ROUGHNESSMAP_UV "+t.roughnessMapUv:"",t.anisotropyMapUv?"#define ANISOTROPYMAP_UV "+t.anisotropyMapUv:"",t.clearcoatMapUv?"#define CLEARCOATMAP_UV "+t.clearcoatMapUv:"",t.clearcoatNormalMapUv?"#define CLEARCOAT_NORMALMAP_UV "+t.clearcoatNormalMapUv:"",t.clearcoatRoughnessMapUv?"#define CLEARCOAT_ROUGHNESSMAP_UV "+t.clearcoatRoughnessMapUv:"",t.diffuseRoughnessMapUv?"#define DIFFUSE_ROUGHNESSMAP_UV "+t.diffuseRoughnessMapUv:"",t.iridescenceMapUv?"#define IRIDESCENCEMAP_UV "+t.iridescenceMapUv:"",t.iridescenceThicknessMapUv?"#define IRIDESCENCE_THICKNESSMAP_UV "+t.iridescenceThicknessMapUv:"",t.sheenColorMapUv?"#define SHEEN_COLORMAP_UV "+t.sheenColorMapUv:"",t.sheenRoughnessMapUv?"#define SHEEN_ROUGHNESSMAP_UV "+t.sheenRoughnessMapUv:"",t.specularMapUv?"#define SPECULARMAP_UV "+t.specularMapUv:"",t.specularColorMapUv?"#define SPECULAR_COLORMAP_UV "+t.specularColorMapUv:"",t.specularIntensityMapUv?"#define SPECULAR_INTENSITYMAP_UV "+t.specularIntensityMapUv:"",t.transmissionMapUv?"#define TRANSMISSIONMAP_UV "+t.transmissionMapUv:"",t.thicknessMapUv?"#define THICKNESSMAP_UV "+t.thicknessMapUv:"",t.vertexTangents&&t.flatShading===!1?"#define USE_TANGENT":"",t.vertexNormals?"#define HAS_NORMAL":"",t.vertexColors?"#define USE_COLOR":"",t.vertexAlphas?"#define USE_COLOR_ALPHA":"",t.vertexUv1s?"#define USE_UV1":"",t.vertexUv2s?"#define USE_UV2":"",t.vertexUv3s?"#define USE_UV3":"",t.pointsUvs?"#define USE_POINTS_UV":"",t.flatShading?"#define FLAT_SHADED":"",t.skinning?"#define USE_SKINNING":"",t.morphTargets?"#define USE_MORPHTARGETS":"",t.morphNormals&&t.flatShading===!1?"#define USE_MORPHNORMALS":"",t.morphColors?"#define USE_MORPHCOLORS":"",t.morphTargetsCount>0?"#define MORPHTARGETS_TEXTURE_STRIDE "+t.morphTextureStride:"",t.morphTargetsCount>0?"#define MORPHTARGETS_COUNT "+t.morphTargetsCount:"",t.doubleSided?"#define DOUBLE_SIDED":"",t.flipSided?"#define FLIP_SIDED":"",t.shadowMapEnabled?"#define USE_SHADOWMAP":"",t.shadowMapEnabled?"#define "+l:"",t.sizeAttenuation?"#define USE_SIZEATTENUATION":"",t.numLightProbes>0?"#define USE_LIGHT_PROBES":"",t.logarithmicDepthBuffer?"#define USE_LOGARITHMIC_DEPTH_BUFFER":"",t.reversedDepthBuffer?"#define USE_REVERSED_DEPTH_BUFFER":"","uniform mat4 modelMatrix;","uniform mat4 modelViewMatrix;","uniform mat4 projectionMatrix;","uniform mat4 viewMatrix;","uniform mat3 normalMatrix;","uniform vec3 cameraPosition;","uniform bool isOrthographic;","#ifdef USE_INSTANCING","	attribute mat4 instanceMatrix;","#endif","#ifdef USE_INSTANCING_COLOR","	attribute vec3 instanceColor;","#endif","#ifdef USE_INSTANCING_MORPH","	uniform sampler2D morphTexture;","#endif","attribute vec3 position;","attribute vec3 normal;","attribute vec2 uv;","#ifdef USE_UV1","	attribute vec2 uv1;","#endif","#ifdef USE_UV2","	attribute vec2 uv2;","#endif","#ifdef USE_UV3","	attribute vec2 uv3;","#endif","#ifdef USE_TANGENT","	attribute vec4 tangent;","#endif","#if defined( USE_COLOR_ALPHA )","	attribute vec4 color;","#elif defined( USE_COLOR )","	attribute vec3 color;","#endif","#ifdef USE_SKINNING","	attribute vec4 skinIndex;","	attribute vec4 skinWeight;","#endif",`
`].filter(ar).join(`
`),p=[md(t),"#define SHADER_TYPE "+t.shaderType,"#define SHADER_NAME "+t.shaderName,d,t.useFog&&t.fog?"#define USE_FOG":"",t.useFog&&t.fogExp2?"#define FOG_EXP2":"",t.alphaToCoverage?"#define ALPHA_TO_COVERAGE":"",t.map?"#define USE_MAP":"",t.matcap?"#define USE_MATCAP":"",t.envMap?"#define USE_ENVMAP":"",t.envMap?"#define "+c:"",t.envMap?"#define "+h:"",t.envMap?"#define "+u:"",t.envMapPMREM?"#define ENVMAP_MAX_LOD "+t.envMapMaxLod+".0":"",t.envMapPMREM?"#define ENVMAP_SIZE "+t.envMapSize+".0":"",t.lightMap?"#define USE_LIGHTMAP":"",t.aoMap?"#define USE_AOMAP":"",t.bumpMap?"#define USE_BUMPMAP":"",t.normalMap?"#define USE_NORMALMAP":"",t.normalMapObjectSpace?"#define USE_NORMALMAP_OBJECTSPACE":"",t.normalMapTangentSpace?"#define USE_NORMALMAP_TANGENTSPACE":"",t.packedNormalMap?"#define USE_PACKED_NORMALMAP":"",t.emissiveMap?"#define USE_EMISSIVEMAP":"",t.anisotropy?"#define USE_ANISOTROPY":"",t.anisotropyMap?"#define USE_ANISOTROPYMAP":"",t.clearcoat?"#define USE_CLEARCOAT":"",t.clearcoatMap?"#define USE_CLEARCOATMAP":"",t.clearcoatRoughnessMap?"#define USE_CLEARCOAT_ROUGHNESSMAP":"",t.clearcoatNormalMap?"#define USE_CLEARCOAT_NORMALMAP":"",t.diffuseRoughness?"#define USE_DIFFUSE_ROUGHNESS":"",t.diffuseRoughnessMap?"#define USE_DIFFUSE_ROUGHNESSMAP":"",t.dispersion?"#define USE_DISPERSION":"",t.retroreflection?"#define USE_RETROREFLECTION":"",t.iridescence?"#define USE_IRIDESCENCE":"",t.iridescenceMap?"#define USE_IRIDESCENCEMAP":"",t.iridescenceThicknessMap?"#define USE_IRIDESCENCE_THICKNESSMAP":"",t.specularMap?"#define USE_SPECULARMAP":"",t.specularColorMap?"#define USE_SPECULAR_COLORMAP":"",t.specularIntensityMap?"#define USE_SPECULAR_INTENSITYMAP":"",t.roughnessMap?"#define USE_ROUGHNESSMAP":"",t.metalnessMap?"#define USE_METALNESSMAP":"",t.alphaMap?"#define USE_ALPHAMAP":"",t.alphaTest?"#define USE_ALPHATEST":"",t.alphaHash?"#define USE_ALPHAHASH":"",t.sheen?"#define USE_SHEEN":"",t.sheenColorMap?"#define USE_SHEEN_COLORMAP":"",t.sheenRoughnessMap?"#define USE_SHEEN_ROUGHNESSMAP":"",t.transmission?"#define USE_TRANSMISSION":"",t.transmissionMap?"#define USE_TRANSMISSIONMAP":"",t.thicknessMap?"#define USE_THICKNESSMAP":"",t.vertexTangents&&t.flatShading===!1?"#define USE_TANGENT":"",t.vertexColors||t.instancingColor?"#define USE_COLOR":"",t.vertexAlphas||t.batchingColor?"#define USE_COLOR_ALPHA":"",t.vertexUv1s?"#define USE_UV1":"",t.vertexUv2s?"#define USE_UV2":"",t.vertexUv3s?"#define USE_UV3":"",t.pointsUvs?"#define USE_POINTS_UV":"",t.gradientMap?"#define USE_GRADIENTMAP":"",t.flatShading?"#define FLAT_SHADED":"",t.doubleSided?"#define DOUBLE_SIDED":"",t.flipSided?"#define FLIP_SIDED":"",t.shadowMapEnabled?"#define USE_SHADOWMAP":"",t.shadowMapEnabled?"#define "+l:"",t.premultipliedAlpha?"#define PREMULTIPLIED_ALPHA":"",t.numLightProbes>0?"#define USE_LIGHT_PROBES":"",t.decodeVideoTexture?"#define DECODE_VIDEO_TEXTURE":"",t.decodeVideoTextureEmissive?"#define DECODE_VIDEO_TEXTURE_EMISSIVE":"",t.logarithmicDepthBuffer?"#define USE_LOGARITHMIC_DEPTH_BUFFER":"",t.reversedDepthBuffer?"#define USE_REVERSED_DEPTH_BUFFER":"","uniform mat4 viewMatrix;","uniform vec3 cameraPosition;","uniform bool isOrthographic;",t.toneMapping!==wn?"#define TONE_MAPPING":"",t.toneMapping!==wn?Ve.tonemapping_pars_fragment:"",t.toneMapping!==wn?Ly("toneMapping",t.toneMapping):"",t.dithering?"#define DITHERING":"",t.opaque?"#define OPAQUE":"",Ve.colorspace_pars_fragment,Py("linearToOutputTexel",t.outputColorSpace),Ny(),t.useDepthPacking?"#define DEPTH_PACKING "+t.depthPacking:"",`
`].filter(ar).join(`
`)),o=Hc(o),o=dd(o,t),o=fd(o,t),a=Hc(a),a=dd(a,t),a=fd(a,t),o=pd(o),a=pd(a),t.isRawShaderMaterial!==!0&&(m=`#version 300 es
`,x=[f,"#define attribute in","#define varying out","#define texture2D texture"].join(`
`)+`
`+x,p=["#define varying in",t.glslVersion===Ic?"":"layout(location = 0) out highp vec4 pc_fragColor;",t.glslVersion===Ic?"":"#define gl_FragColor pc_fragColor","#define gl_FragDepthEXT gl_FragDepth","#define texture2D texture","#define textureCube texture","#define texture2DProj textureProj","#define texture2DLodEXT textureLod","#define texture2DProjLodEXT textureProjLod","#define textureCubeLodEXT textureLod","#define texture2DGradEXT textureGrad","#define texture2DProjGradEXT textureProjGrad","#define textureCubeGradEXT textureGrad"].join(`
`)+`
`+p);let b=m+x+o,T=m+p+a,E=cd(i,i.VERTEX_SHADER,b),M=cd(i,i.FRAGMENT_SHADER,T);i.attachShader(g,E),i.attachShader(g,M),t.index0AttributeName!==void 0?i.bindAttribLocation(g,0,t.index0AttributeName):t.hasPositionAttribute===!0&&i.bindAttribLocation(g,0,"position"),i.linkProgram(g);function w(R){if(s.debug.checkShaderErrors){let N=i.getProgramInfoLog(g)||"",O=i.getShaderInfoLog(E)||"",D=i.getShaderInfoLog(M)||"",P=N.trim(),V=O.trim(),W=D.trim(),G=!0,ee=!0;if(i.getProgramParameter(g,i.LINK_STATUS)===!1)if(G=!1,typeof s.debug.onShaderError=="function")s.debug.onShaderError(i,g,E,M);else{let X=ud(i,E,"vertex"),Q=ud(i,M,"fragment");Le("WebGLProgram: Shader Error "+i.getError()+" - VALIDATE_STATUS "+i.getProgramParameter(g,i.VALIDATE_STATUS)+`

Material Name: `+R.name+`
Material Type: `+R.type+`

Program Info Log: `+P+`
`+X+`
`+Q)}else P!==""?Ce("WebGLProgram: Program Info Log:",P):(V===""||W==="")&&(ee=!1);ee&&(R.diagnostics={runnable:G,programLog:P,vertexShader:{log:V,prefix:x},fragmentShader:{log:W,prefix:p}})}i.deleteShader(E),i.deleteShader(M),y=new ls(i,g),S=Uy(i,g)}let y;this.getUniforms=function(){return y===void 0&&w(this),y};let S;this.getAttributes=function(){return S===void 0&&w(this),S};let I=t.rendererExtensionParallelShaderCompile===!1;return this.isReady=function(){return I===!1&&(I=i.getProgramParameter(g,Ay)),I},this.destroy=function(){n.releaseStatesOfProgram(this),i.deleteProgram(g),this.program=void 0},this.type=t.shaderType,this.name=t.shaderName,this.id=Ty++,this.cacheKey=e,this.usedTimes=1,this.program=g,this.vertexShader=E,this.fragmentShader=M,this}var $y=0,Wc=class{constructor(){this.shaderCache=new Map,this.materialCache=new Map}update(e,t,n){let i=this._getShaderCacheForMaterial(e);return i.has(t)===!1&&(i.add(t),t.usedTimes++),i.has(n)===!1&&(i.add(n),n.usedTimes++),this}remove(e){let t=this.materialCache.get(e);for(let n of t)n.usedTimes--,n.usedTimes===0&&this.shaderCache.delete(n.code);return this.materialCache.delete(e),this}getVertexShaderStage(e){return this._getShaderStage(e.vertexShader)}getFragmentShaderStage(e){return this._getShaderStage(e.fragmentShader)}dispose(){this.shaderCache.clear(),this.materialCache.clear()}_getShaderCacheForMaterial(e){let t=this.materialCache,n=t.get(e);return n===void 0&&(n=new Set,t.set(e,n)),n}_getShaderStage(e){let t=this.shaderCache,n=t.get(e);return n===void 0&&(n=new Xc(e),t.set(e,n)),n}},Xc=class{constructor(e){this.id=$y++,this.code=e,this.usedTimes=0}};function Zy(s){return s===ci||s===ir||s===sr}function Jy(s,e,t,n,i,r){let o=new Ls,a=new Wc,l=new Set,c=[],h=new Map,u=n.logarithmicDepthBuffer,f={MeshDepthMaterial:"depth",MeshDistanceMaterial:"distance",MeshNormalMaterial:"normal",MeshBasicMaterial:"basic",MeshLambertMaterial:"lambert",MeshPhongMaterial:"phong",MeshToonMaterial:"toon",MeshStandardMaterial:"physical",MeshPhysicalMaterial:"physical",MeshMatcapMaterial:"matcap",LineBasicMaterial:"basic",LineDashedMaterial:"dashed",PointsMaterial:"points",ShadowMaterial:"shadow",SpriteMaterial:"sprite"};function d(y){return l.add(y),y===0?"uv":`uv${y}`}function g(y,S,I,R,N,O){let D=R.fog,P=N.geometry,V=y.isMeshStandardMaterial||y.isMeshLambertMaterial||y.isMeshPhongMaterial?R.environment:null,W=y.isMeshStandardMaterial||y.isMeshLambertMaterial&&!y.envMap||y.isMeshPhongMaterial&&!y.envMap,G=e.get(y.envMap||V,W),ee=f[y.type],X=n.precision;y.precision!==null&&(X=n.getMaxPrecision(y.precision),X!==y.precision&&Ce("WebGLProgram.getParameters:",y.precision,"not supported, using",X,"instead."));let Q=P.morphAttributes.position||P.morphAttributes.normal||P.morphAttributes.color,te=Q!==void 0?Q.length:0,Me=0;P.morphAttributes.position!==void 0&&(Me=1),P.morphAttributes.normal!==void 0&&(Me=2),P.morphAttributes.color!==void 0&&(Me=3);let Fe,J,me,ve;if(ee){let fe=An[ee];Fe=fe.vertexShader,J=fe.fragmentShader}else{Fe=y.vertexShader,J=y.fragmentShader;let fe=a.getVertexShaderStage(y),Ke=a.getFragmentShaderStage(y);a.update(y,fe,Ke),me=fe.id,ve=Ke.id}let Te=s.getRenderTarget(),ge=s.state.buffers.depth.getReversed(),Oe=N.isInstancedMesh===!0,dt=N.isBatchedMesh===!0,Pe=!!y.map,Je=!!y.matcap,Qe=!!G,Ge=Qe&&G.isPMREMTexture===!0,At=!!y.aoMap,mt=!!y.lightMap,zt=!!y.bumpMap&&y.wireframe===!1,lt=!!y.normalMap,yn=!!y.displacementMap,vt=!!y.emissiveMap,Jt=!!y.metalnessMap,Kt=!!y.roughnessMap,jt=y.anisotropy>0,F=y.clearcoat>0,Qt=y.diffuseRoughness>0,rt=y.dispersion>0,ot=y.retroreflectivity>0,de=y.iridescence>0,gt=y.sheen>0,Re=y.transmission>0,De=jt&&!!y.anisotropyMap,A=F&&!!y.clearcoatMap,v=F&&!!y.clearcoatNormalMap,k=F&&!!y.clearcoatRoughnessMap,ne=Qt&&!!y.diffuseRoughnessMap,j=de&&!!y.iridescenceMap,re=de&&!!y.iridescenceThicknessMap,he=gt&&!!y.sheenColorMap,Y=gt&&!!y.sheenRoughnessMap,$=!!y.specularMap,ae=!!y.specularColorMap,C=!!y.specularIntensityMap,K=Re&&!!y.transmissionMap,q=Re&&!!y.thicknessMap,le=!!y.gradientMap,se=!!y.alphaMap,oe=y.alphaTest>0,we=!!y.alphaHash,ze=!!y.extensions,ie=wn;y.toneMapped&&(Te===null||Te.isXRRenderTarget===!0)&&(ie=s.toneMapping);let Ee=Ge?G.isCompressedCubeTexture?G.image[0].mipmaps:G.mipmaps:null,ke={shaderID:ee,shaderType:y.type,shaderName:y.name,vertexShader:Fe,fragmentShader:J,defines:y.defines,customVertexShaderID:me,customFragmentShaderID:ve,isRawShaderMaterial:y.isRawShaderMaterial===!0,glslVersion:y.glslVersion,precision:X,batching:dt,batchingColor:dt&&N._colorsTexture!==null,instancing:Oe,instancingColor:Oe&&N.instanceColor!==null,instancingMorph:Oe&&N.morphTexture!==null,outputColorSpace:Te===null?s.outputColorSpace:Te.isXRRenderTarget===!0?Te.texture.colorSpace:Xe.workingColorSpace,alphaToCoverage:!!y.alphaToCoverage,map:Pe,matcap:Je,envMap:Qe,envMapMode:Qe&&G.mapping,envMapPMREM:Ge,envMapMaxLod:Ge?Ee.length-1:null,envMapSize:Ge?Ee[0].width:null,aoMap:At,lightMap:mt,bumpMap:zt,normalMap:lt,displacementMap:yn,emissiveMap:vt,normalMapObjectSpace:lt&&y.normalMapType===Uu,normalMapTangentSpace:lt&&y.normalMapType===Na,packedNormalMap:lt&&y.normalMapType===Na&&Zy(y.normalMap.format),metalnessMap:Jt,roughnessMap:Kt,anisotropy:jt,anisotropyMap:De,clearcoat:F,clearcoatMap:A,clearcoatNormalMap:v,clearcoatRoughnessMap:k,diffuseRoughness:Qt,diffuseRoughnessMap:ne,dispersion:rt,retroreflection:ot,iridescence:de,iridescenceMap:j,iridescenceThicknessMap:re,sheen:gt,sheenColorMap:he,sheenRoughnessMap:Y,specularMap:$,specularColorMap:ae,specularIntensityMap:C,transmission:Re,transmissionMap:K,thicknessMap:q,gradientMap:le,opaque:y.transparent===!1&&y.blending===rs&&y.alphaToCoverage===!1,alphaMap:se,alphaTest:oe,alphaHash:we,combine:y.combine,mapUv:Pe&&d(y.map.channel),aoMapUv:At&&d(y.aoMap.channel),lightMapUv:mt&&d(y.lightMap.channel),bumpMapUv:zt&&d(y.bumpMap.channel),normalMapUv:lt&&d(y.normalMap.channel),displacementMapUv:yn&&d(y.displacementMap.channel),emissiveMapUv:vt&&d(y.emissiveMap.channel),metalnessMapUv:Jt&&d(y.metalnessMap.channel),roughnessMapUv:Kt&&d(y.roughnessMap.channel),anisotropyMapUv:De&&d(y.anisotropyMap.channel),clearcoatMapUv:A&&d(y.clearcoatMap.channel),clearcoatNormalMapUv:v&&d(y.clearcoatNormalMap.channel),clearcoatRoughnessMapUv:k&&d(y.clearcoatRoughnessMap.channel),diffuseRoughnessMapUv:ne&&d(y.diffuseRoughnessMap.channel),iridescenceMapUv:j&&d(y.iridescenceMap.channel),iridescenceThicknessMapUv:re&&d(y.iridescenceThicknessMap.channel),sheenColorMapUv:he&&d(y.sheenColorMap.channel),sheenRoughnessMapUv:Y&&d(y.sheenRoughnessMap.channel),specularMapUv:$&&d(y.specularMap.channel),specularColorMapUv:ae&&d(y.specularColorMap.channel),specularIntensityMapUv:C&&d(y.specularIntensityMap.channel),transmissionMapUv:K&&d(y.transmissionMap.channel),thicknessMapUv:q&&d(y.thicknessMap.channel),alphaMapUv:se&&d(y.alphaMap.channel),vertexTangents:!!P.attributes.tangent&&(lt||jt),vertexNormals:!!P.attributes.normal,vertexColors:y.vertexColors,vertexAlphas:y.vertexColors===!0&&!!P.attributes.color&&P.attributes.color.itemSize===4,pointsUvs:N.isPoints===!0&&!!P.attributes.uv&&(Pe||se),fog:!!D,useFog:y.fog===!0,fogExp2:!!D&&D.isFogExp2,flatShading:y.wireframe===!1&&(y.flatShading===!0||P.attributes.normal===void 0&&lt===!1&&(y.isMeshLambertMaterial||y.isMeshPhongMaterial||y.isMeshStandardMaterial||y.isMeshPhysicalMaterial)),sizeAttenuation:y.sizeAttenuation===!0,logarithmicDepthBuffer:u,reversedDepthBuffer:ge,skinning:N.isSkinnedMesh===!0,hasPositionAttribute:P.attributes.position!==void 0,morphTargets:P.morphAttributes.position!==void 0,morphNormals:P.morphAttributes.normal!==void 0,morphColors:P.morphAttributes.color!==void 0,morphTargetsCount:te,morphTextureStride:Me,numSunLights:S.sun.length,numDirLights:S.directional.length,numPointLights:S.point.length,numSpotLights:S.spot.length,numSpotLightMaps:S.spotLightMap.length,numRectAreaLights:S.rectArea.length,numHemiLights:S.hemi.length,numSunLightShadows:S.sunShadowMap.length,numDirLightShadows:S.directionalShadowMap.length,numPointLightShadows:S.pointShadowMap.length,numSpotLightShadows:S.spotShadowMap.length,numSpotLightShadowsWithMaps:S.numSpotLightShadowsWithMaps,numLightProbes:S.numLightProbes,numLightProbeGrids:O.filter(fe=>fe.texture!==null).length,numClippingPlanes:r.numPlanes,numClipIntersection:r.numIntersection,dithering:y.dithering,shadowMapEnabled:s.shadowMap.enabled&&I.length>0,shadowMapType:s.shadowMap.type,toneMapping:ie,decodeVideoTexture:Pe&&y.map.isVideoTexture===!0&&Xe.getTransfer(y.map.colorSpace)===Ze,decodeVideoTextureEmissive:vt&&y.emissiveMap.isVideoTexture===!0&&Xe.getTransfer(y.emissiveMap.colorSpace)===Ze,premultipliedAlpha:y.premultipliedAlpha,doubleSided:y.side===Gt,flipSided:y.side===Ct,useDepthPacking:y.depthPacking>=0,depthPacking:y.depthPacking||0,index0AttributeName:y.index0AttributeName,extensionClipCullDistance:ze&&y.extensions.clipCullDistance===!0&&t.has("WEBGL_clip_cull_distance"),extensionMultiDraw:(ze&&y.extensions.multiDraw===!0||dt)&&t.has("WEBGL_multi_draw"),rendererExtensionParallelShaderCompile:t.has("KHR_parallel_shader_compile"),customProgramCacheKey:y.customProgramCacheKey()};return ke.vertexUv1s=l.has(1),ke.vertexUv2s=l.has(2),ke.vertexUv3s=l.has(3),l.clear(),ke}function x(y){let S=[];if(y.shaderID?S.push(y.shaderID):(S.push(y.customVertexShaderID),S.push(y.customFragmentShaderID)),y.defines!==void 0)for(let I in y.defines)S.push(I),S.push(y.defines[I]);return y.isRawShaderMaterial===!1&&(p(S,y),m(S,y),S.push(s.outputColorSpace)),S.push(y.customProgramCacheKey),S.join()}function p(y,S){y.push(S.precision),y.push(S.outputColorSpace),y.push(S.envMapMode),y.push(S.envMapPMREM),y.push(S.envMapMaxLod),y.push(S.envMapSize),y.push(S.mapUv),y.push(S.alphaMapUv),y.push(S.lightMapUv),y.push(S.aoMapUv),y.push(S.bumpMapUv),y.push(S.normalMapUv),y.push(S.displacementMapUv),y.push(S.emissiveMapUv),y.push(S.metalnessMapUv),y.push(S.roughnessMapUv),y.push(S.anisotropyMapUv),y.push(S.clearcoatMapUv),y.push(S.clearcoatNormalMapUv),y.push(S.clearcoatRoughnessMapUv),y.push(S.diffuseRoughnessMapUv),y.push(S.iridescenceMapUv),y.push(S.iridescenceThicknessMapUv),y.push(S.sheenColorMapUv),y.push(S.sheenRoughnessMapUv),y.push(S.specularMapUv),y.push(S.specularColorMapUv),y.push(S.specularIntensityMapUv),y.push(S.transmissionMapUv),y.push(S.thicknessMapUv),y.push(S.combine),y.push(S.fogExp2),y.push(S.sizeAttenuation),y.push(S.morphTargetsCount),y.push(S.numSunLights),y.push(S.numDirLights),y.push(S.numPointLights),y.push(S.numSpotLights),y.push(S.numSpotLightMaps),y.push(S.numHemiLights),y.push(S.numRectAreaLights),y.push(S.numSunLightShadows),y.push(S.numDirLightShadows),y.push(S.numPointLightShadows),y.push(S.numSpotLightShadows),y.push(S.numSpotLightShadowsWithMaps),y.push(S.numLightProbes),y.push(S.numLightProbeGrids),y.push(S.shadowMapType),y.push(S.toneMapping),y.push(S.numClippingPlanes),y.push(S.numClipIntersection),y.push(S.depthPacking)}function m(y,S){o.disableAll(),S.instancing&&o.enable(0),S.instancingColor&&o.enable(1),S.instancingMorph&&o.enable(2),S.matcap&&o.enable(3),S.envMap&&o.enable(4),S.normalMapObjectSpace&&o.enable(5),S.normalMapTangentSpace&&o.enable(6),S.clearcoat&&o.enable(7),S.iridescence&&o.enable(8),S.alphaTest&&o.enable(9),S.vertexColors&&o.enable(10),S.vertexAlphas&&o.enable(11),S.vertexUv1s&&o.enable(12),S.vertexUv2s&&o.enable(13),S.vertexUv3s&&o.enable(14),S.vertexTangents&&o.enable(15),S.anisotropy&&o.enable(16),S.alphaHash&&o.enable(17),S.batching&&o.enable(18),S.dispersion&&o.enable(19),S.retroreflection&&o.enable(24),S.diffuseRoughness&&o.enable(25),S.batchingColor&&o.enable(20),S.gradientMap&&o.enable(21),S.packedNormalMap&&o.enable(22),S.vertexNormals&&o.enable(23),y.push(o.mask),o.disableAll(),S.fog&&o.enable(0),S.useFog&&o.enable(1),S.flatShading&&o.enable(2),S.logarithmicDepthBuffer&&o.enable(3),S.reversedDepthBuffer&&o.enable(4),S.skinning&&o.enable(5),S.morphTargets&&o.enable(6),S.morphNormals&&o.enable(7),S.morphColors&&o.enable(8),S.premultipliedAlpha&&o.enable(9),S.shadowMapEnabled&&o.enable(10),S.doubleSided&&o.enable(11),S.flipSided&&o.enable(12),S.useDepthPacking&&o.enable(13),S.dithering&&o.enable(14),S.transmission&&o.enable(15),S.sheen&&o.enable(16),S.opaque&&o.enable(17),S.pointsUvs&&o.enable(18),S.decodeVideoTexture&&o.enable(19),S.decodeVideoTextureEmissive&&o.enable(20),S.alphaToCoverage&&o.enable(21),S.numLightProbeGrids>0&&o.enable(22),S.hasPositionAttribute&&o.enable(23),y.push(o.mask)}function b(y){let S=f[y.type],I;if(S){let R=An[S];I=Ju.clone(R.uniforms)}else I=y.uniforms;return I}function T(y,S){let I=h.get(S);return I!==void 0?++I.usedTimes:(I=new Yy(s,S,y,i),c.push(I),h.set(S,I)),I}function E(y){if(--y.usedTimes===0){let S=c.indexOf(y);c[S]=c[c.length-1],c.pop(),h.delete(y.cacheKey),y.destroy()}}function M(y){a.remove(y)}function w(){a.dispose()}return{getParameters:g,getProgramCacheKey:x,getUniforms:b,acquireProgram:T,releaseProgram:E,releaseShaderCache:M,programs:c,dispose:w}}function Ky(){let s=new WeakMap;function e(o){return s.has(o)}function t(o){let a=s.get(o);return a===void 0&&(a={},s.set(o,a)),a}function n(o){s.delete(o)}function i(o,a,l){s.get(o)[a]=l}function r(){s=new WeakMap}return{has:e,get:t,remove:n,update:i,dispose:r}}function jy(s,e){return s.groupOrder!==e.groupOrder?s.groupOrder-e.groupOrder:s.renderOrder!==e.renderOrder?s.renderOrder-e.renderOrder:s.material.id!==e.material.id?s.material.id-e.material.id:s.materialVariant!==e.materialVariant?s.materialVariant-e.materialVariant:s.z!==e.z?s.z-e.z:s.id-e.id}function gd(s,e){return s.groupOrder!==e.groupOrder?s.groupOrder-e.groupOrder:s.renderOrder!==e.renderOrder?s.renderOrder-e.renderOrder:s.z!==e.z?e.z-s.z:s.id-e.id}function yd(){let s=[],e=0,t=[],n=[],i=[];function r(){e=0,t.length=0,n.length=0,i.length=0}function o(f){let d=0;return f.isInstancedMesh&&(d+=2),f.isSkinnedMesh&&(d+=1),d}function a(f,d,g,x,p,m){let b=s[e];return b===void 0?(b={id:f.id,object:f,geometry:d,material:g,materialVariant:o(f),groupOrder:x,renderOrder:f.renderOrder,z:p,group:m},s[e]=b):(b.id=f.id,b.object=f,b.geometry=d,b.material=g,b.materialVariant=o(f),b.groupOrder=x,b.renderOrder=f.renderOrder,b.z=p,b.group=m),e++,b}function l(f,d,g,x,p,m,b){b.reversedDepth===!0&&(p=-p);let T=a(f,d,g,x,p,m);g.transmission>0?n.push(T):g.transparent===!0?i.push(T):t.push(T)}function c(f,d,g,x,p,m){let b=a(f,d,g,x,p,m);g.transmission>0?n.unshift(b):g.transparent===!0?i.unshift(b):t.unshift(b)}function h(f,d){t.length>1&&t.sort(f||jy),n.length>1&&n.sort(d||gd),i.length>1&&i.sort(d||gd)}function u(){for(let f=e,d=s.length;f<d;f++){let g=s[f];if(g.id===null)break;g.id=null,g.object=null,g.geometry=null,g.material=null,g.group=null}}return{opaque:t,transmissive:n,transparent:i,init:r,push:l,unshift:c,finish:u,sort:h}}function Qy(){let s=new WeakMap;function e(n,i){let r=s.get(n),o;return r===void 0?(o=new yd,s.set(n,[o])):i>=r.length?(o=new yd,r.push(o)):o=r[i],o}function t(){s=new WeakMap}return{get:e,dispose:t}}function ex(){let s={};return{get:function(e){if(s[e.id]!==void 0)return s[e.id];let t;switch(e.type){case"SunLight":case"DirectionalLight":t={direction:new U,color:new Ie};break;case"SpotLight":t={position:new U,direction:new U,color:new Ie,distance:0,coneCos:0,penumbraCos:0,decay:0};break;case"PointLight":t={position:new U,color:new Ie,distance:0,decay:0};break;case"HemisphereLight":t={direction:new U,skyColor:new Ie,groundColor:new Ie};break;case"RectAreaLight":t={color:new Ie,position:new U,halfWidth:new U,halfHeight:new U};break}return s[e.id]=t,t}}}function tx(){let s={};return{get:function(e){if(s[e.id]!==void 0)return s[e.id];let t;switch(e.type){case"SunLight":case"DirectionalLight":t={shadowIntensity:1,shadowBias:0,shadowNormalBias:0,shadowRadius:1,shadowMapSize:new Be};break;case"SpotLight":t={shadowIntensity:1,shadowBias:0,shadowNormalBias:0,shadowRadius:1,shadowMapSize:new Be};break;case"PointLight":t={shadowIntensity:1,shadowBias:0,shadowNormalBias:0,shadowRadius:1,shadowMapSize:new Be,shadowCameraNear:1,shadowCameraFar:1e3};break}return s[e.id]=t,t}}}var nx=0;function ix(s,e){return(e.castShadow?2:0)-(s.castShadow?2:0)+(e.map?1:0)-(s.map?1:0)}function sx(s){let e=new ex,t=tx(),n={version:0,hash:{sunLength:-1,directionalLength:-1,pointLength:-1,spotLength:-1,rectAreaLength:-1,hemiLength:-1,numSunShadows:-1,numDirectionalShadows:-1,numPointShadows:-1,numSpotShadows:-1,numSpotMaps:-1,numLightProbes:-1},ambient:[0,0,0],probe:[],sun:[],sunShadow:[],sunShadowMap:[],sunShadowMatrix:[],sunShadowCascade:[],directional:[],directionalShadow:[],directionalShadowMap:[],directionalShadowMatrix:[],spot:[],spotLightMap:[],spotShadow:[],spotShadowMap:[],spotLightMatrix:[],rectArea:[],rectAreaLTC1:null,rectAreaLTC2:null,point:[],pointShadow:[],pointShadowMap:[],pointShadowMatrix:[],hemi:[],numSpotLightShadowsWithMaps:0,numLightProbes:0};for(let c=0;c<9;c++)n.probe.push(new U);let i=new U,r=new je,o=new je;function a(c){let h=0,u=0,f=0;for(let O=0;O<9;O++)n.probe[O].set(0,0,0);let d=0,g=0,x=0,p=0,m=0,b=0,T=0,E=0,M=0,w=0,y=0,S=0,I=0,R=0;c.sort(ix);for(let O=0,D=c.length;O<D;O++){let P=c[O],V=P.color,W=P.intensity,G=P.distance,ee=null;if(P.shadow&&P.shadow.map&&(P.shadow.map.texture.format===ci?ee=P.shadow.map.texture:ee=P.shadow.map.depthTexture||P.shadow.map.texture),P.isAmbientLight)h+=V.r*W,u+=V.g*W,f+=V.b*W;else if(P.isLightProbe){for(let X=0;X<9;X++)n.probe[X].addScaledVector(P.sh.coefficients[X],W);R++}else if(P.isSunLight){let X=e.get(P);if(X.color.copy(P.color).multiplyScalar(P.intensity),P.castShadow){let Q=P.shadow,te=t.get(P);te.shadowIntensity=Q.intensity,te.shadowBias=Q.bias,te.shadowNormalBias=Q.normalBias,te.shadowRadius=Q.radius,te.shadowMapSize.copy(Q.mapSize).multiply(Q.getFrameExtents()),n.sunShadow[g]=te,n.sunShadowMap[g]=ee;let Me=Q.getViewportCount();for(let Fe=0;Fe<Me;Fe++)n.sunShadowMatrix[x+Fe]=Q.getMatrix(Fe),n.sunShadowCascade[x+Fe]=Q._cascadeData[Fe];x+=Me,g++}n.sun[d]=X,d++}else if(P.isDirectionalLight){let X=e.get(P);if(X.color.copy(P.color).multiplyScalar(P.intensity),P.castShadow){let Q=P.shadow,te=t.get(P);te.shadowIntensity=Q.intensity,te.shadowBias=Q.bias,te.shadowNormalBias=Q.normalBias,te.shadowRadius=Q.radius,te.shadowMapSize=Q.mapSize,n.directionalShadow[p]=te,n.directionalShadowMap[p]=ee,n.directionalShadowMatrix[p]=P.shadow.matrix,M++}n.directional[p]=X,p++}else if(P.isSpotLight){let X=e.get(P);X.position.setFromMatrixPosition(P.matrixWorld),X.color.copy(V).multiplyScalar(W),X.distance=G,X.coneCos=Math.cos(P.angle),X.penumbraCos=Math.cos(P.angle*(1-P.penumbra)),X.decay=P.decay,n.spot[b]=X;let Q=P.shadow;if(P.map&&(n.spotLightMap[S]=P.map,S++,Q.updateMatrices(P),P.castShadow&&I++),n.spotLightMatrix[b]=Q.matrix,P.castShadow){let te=t.get(P);te.shadowIntensity=Q.intensity,te.shadowBias=Q.bias,te.shadowNormalBias=Q.normalBias,te.shadowRadius=Q.radius,te.shadowMapSize=Q.mapSize,n.spotShadow[b]=te,n.spotShadowMap[b]=ee,y++}b++}else if(P.isRectAreaLight){let X=e.get(P);X.color.copy(V).multiplyScalar(W),X.halfWidth.set(P.width*.5,0,0),X.halfHeight.set(0,P.height*.5,0),n.rectArea[T]=X,T++}else if(P.isPointLight){let X=e.get(P);if(X.color.copy(P.color).multiplyScalar(P.intensity),X.distance=P.distance,X.decay=P.decay,P.castShadow){let Q=P.shadow,te=t.get(P);te.shadowIntensity=Q.intensity,te.shadowBias=Q.bias,te.shadowNormalBias=Q.normalBias,te.shadowRadius=Q.radius,te.shadowMapSize=Q.mapSize,te.shadowCameraNear=Q.camera.near,te.shadowCameraFar=Q.camera.far,n.pointShadow[m]=te,n.pointShadowMap[m]=ee,n.pointShadowMatrix[m]=P.shadow.matrix,w++}n.point[m]=X,m++}else if(P.isHemisphereLight){let X=e.get(P);X.skyColor.copy(P.color).multiplyScalar(W),X.groundColor.copy(P.groundColor).multiplyScalar(W),n.hemi[E]=X,E++}}T>0&&(s.has("OES_texture_float_linear")===!0?(n.rectAreaLTC1=pe.LTC_FLOAT_1,n.rectAreaLTC2=pe.LTC_FLOAT_2):(n.rectAreaLTC1=pe.LTC_HALF_1,n.rectAreaLTC2=pe.LTC_HALF_2)),n.ambient[0]=h,n.ambient[1]=u,n.ambient[2]=f;let N=n.hash;(N.sunLength!==d||N.directionalLength!==p||N.pointLength!==m||N.spotLength!==b||N.rectAreaLength!==T||N.hemiLength!==E||N.numSunShadows!==g||N.numDirectionalShadows!==M||N.numPointShadows!==w||N.numSpotShadows!==y||N.numSpotMaps!==S||N.numLightProbes!==R)&&(n.sun.length=d,n.directional.length=p,n.spot.length=b,n.rectArea.length=T,n.point.length=m,n.hemi.length=E,n.sunShadow.length=g,n.sunShadowMap.length=g,n.sunShadowMatrix.length=x,n.sunShadowCascade.length=x,n.directionalShadow.length=M,n.directionalShadowMap.length=M,n.directionalShadowMatrix.length=M,n.pointShadow.length=w,n.pointShadowMap.length=w,n.pointShadowMatrix.length=w,n.spotShadow.length=y,n.spotShadowMap.length=y,n.spotLightMatrix.length=y+S-I,n.spotLightMap.length=S,n.numSpotLightShadowsWithMaps=I,n.numLightProbes=R,N.sunLength=d,N.directionalLength=p,N.pointLength=m,N.spotLength=b,N.rectAreaLength=T,N.hemiLength=E,N.numSunShadows=g,N.numDirectionalShadows=M,N.numPointShadows=w,N.numSpotShadows=y,N.numSpotMaps=S,N.numLightProbes=R,n.version=nx++)}function l(c,h){let u=0,f=0,d=0,g=0,x=0,p=0,m=h.matrixWorldInverse;for(let b=0,T=c.length;b<T;b++){let E=c[b];if(E.isSunLight){let M=n.sun[u];M.direction.setFromMatrixPosition(E.matrixWorld),M.direction.transformDirection(m),u++}else if(E.isDirectionalLight){let M=n.directional[f];M.direction.setFromMatrixPosition(E.matrixWorld),i.setFromMatrixPosition(E.target.matrixWorld),M.direction.sub(i),M.direction.transformDirection(m),f++}else if(E.isSpotLight){let M=n.spot[g];M.position.setFromMatrixPosition(E.matrixWorld),M.position.applyMatrix4(m),M.direction.setFromMatrixPosition(E.matrixWorld),i.setFromMatrixPosition(E.target.matrixWorld),M.direction.sub(i),M.direction.transformDirection(m),g++}else if(E.isRectAreaLight){let M=n.rectArea[x];M.position.setFromMatrixPosition(E.matrixWorld),M.position.applyMatrix4(m),o.identity(),r.copy(E.matrixWorld),r.premultiply(m),o.extractRotation(r),M.halfWidth.set(E.width*.5,0,0),M.halfHeight.set(0,E.height*.5,0),M.halfWidth.applyMatrix4(o),M.halfHeight.applyMatrix4(o),x++}else if(E.isPointLight){let M=n.point[d];M.position.setFromMatrixPosition(E.matrixWorld),M.position.applyMatrix4(m),d++}else if(E.isHemisphereLight){let M=n.hemi[p];M.direction.setFromMatrixPosition(E.matrixWorld),M.direction.transformDirection(m),p++}}}return{setup:a,setupView:l,state:n}}function xd(s){let e=new sx(s),t=[],n=[],i=[];function r(u){h.camera=u,t.length=0,n.length=0,i.length=0}function o(u){u.isLightProbeGrid?i.push(u):t.push(u)}function a(u){n.push(u)}function l(){e.setup(t),i.sort((u,f)=>u.priority-f.priority||u.id-f.id)}function c(u){e.setupView(t,u)}let h={lightsArray:t,shadowsArray:n,lightProbeGridArray:i,camera:null,lights:e,transmissionRenderTarget:{},textureUnits:0};return{init:r,state:h,setupLights:l,setupLightsView:c,pushLight:o,pushShadow:a}}function rx(s){let e=new WeakMap;function t(i,r=0){let o=e.get(i),a;return o===void 0?(a=new xd(s),e.set(i,[a])):r>=o.length?(a=new xd(s),o.push(a)):a=o[r],a}function n(){e=new WeakMap}return{get:t,dispose:n}}var ox=`void main(){
gl_Position=vec4(position,1.0);
}`,ax=`uniform sampler2D shadow_pass;
uniform vec2 resolution;
uniform float radius;
void main(){
const float samples=float(VSM_SAMPLES);
float mean=0.0;
float squared_mean=0.0;
float uvStride=samples<=1.0?0.0:2.0 /(samples - 1.0);
float uvStart=samples<=1.0?0.0:- 1.0;
for(float i=0.0;i<samples;i ++){
float uvOffset=uvStart + i*uvStride;
#ifdef HORIZONTAL_PASS
vec2 distribution=texture2D(shadow_pass,(gl_FragCoord.xy + vec2(uvOffset,0.0)*radius)/ resolution).rg;
mean +=distribution.x;
squared_mean +=distribution.y*distribution.y + distribution.x*distribution.x;
#else
float depth=texture2D(shadow_pass,(gl_FragCoord.xy + vec2(0.0,uvOffset)*radius)/ resolution).r;
mean +=depth;
squared_mean +=depth*depth;
#endif
}
mean=mean / samples;
squared_mean=squared_mean / samples;
float std_dev=sqrt(max(0.0,squared_mean - mean*mean));
gl_FragColor=vec4(mean,std_dev,0.0,1.0);
}`,lx=[new U(1,0,0),new U(-1,0,0),new U(0,1,0),new U(0,-1,0),new U(0,0,1),new U(0,0,-1)],cx=[new U(0,-1,0),new U(0,-1,0),new U(0,0,1),new U(0,0,-1),new U(0,-1,0),new U(0,-1,0)],vd=new je,or=new U,kc=new U;function hx(s,e,t){let n=new ni,i=new Be,r=new Be,o=new at,a=new No,l=new Do,c={},h=t.maxTextureSize,u={[li]:Ct,[Ct]:li,[Gt]:Gt},f=new Dt({defines:{VSM_SAMPLES:8},uniforms:{shadow_pass:{value:null},resolution:{value:new Be},radius:{value:4}},vertexShader:ox,fragmentShader:ax}),d=f.clone();d.defines.HORIZONTAL_PASS=1;let g=new Et;g.setAttribute("position",new Bt(new Float32Array([-1,-1,.5,3,-1,.5,-1,3,.5]),3));let x=new ht(g,f),p=this;this.enabled=!1,this.autoUpdate=!0,this.needsUpdate=!1,this.type=vi;let m=this.type;this.render=function(w,y,S){if(p.enabled===!1||p.autoUpdate===!1&&p.needsUpdate===!1||w.length===0)return;this.type===fu&&(Ce("WebGLShadowMap: PCFSoftShadowMap has been removed. Using PCFShadowMap instead."),this.type=vi);let I=s.getRenderTarget(),R=s.getActiveCubeFace(),N=s.getActiveMipmapLevel(),O=s.state;O.setBlending(_i),O.buffers.depth.getReversed()===!0?O.buffers.color.setClear(0,0,0,0):O.buffers.color.setClear(1,1,1,1),O.buffers.depth.setTest(!0),O.setScissorTest(!1);let D=m!==this.type;D&&y.traverse(function(P){P.material&&(Array.isArray(P.material)?P.material.forEach(V=>V.needsUpdate=!0):P.material.needsUpdate=!0)});for(let P=0,V=w.length;P<V;P++){let W=w[P],G=W.shadow;if(G===void 0){Ce("WebGLShadowMap:",W,"has no shadow.");continue}if(G.autoUpdate===!1&&G.needsUpdate===!1)continue;i.copy(G.mapSize);let ee=G.getFrameExtents();i.multiply(ee),r.copy(G.mapSize),(i.x>h||i.y>h)&&(i.x>h&&(r.x=Math.floor(h/ee.x),i.x=r.x*ee.x,G.mapSize.x=r.x),i.y>h&&(r.y=Math.floor(h/ee.y),i.y=r.y*ee.y,G.mapSize.y=r.y));let X=s.state.buffers.depth.getReversed();if(G.camera._reversedDepth=X,G.map===null||D===!0){if(G.map!==null&&(G.map.depthTexture!==null&&(G.map.depthTexture.dispose(),G.map.depthTexture=null),G.map.dispose()),this.type===ss){if(W.isPointLight){Ce("WebGLShadowMap: VSM shadow maps are not supported for PointLights. Use PCF or BasicShadowMap instead.");continue}G.map=new $t(i.x,i.y,{format:ci,type:pn,minFilter:kt,magFilter:kt,generateMipmaps:!1}),G.map.texture.name=W.name+".shadowMap",G.map.depthTexture=new zn(i.x,i.y,fn),G.map.depthTexture.name=W.name+".shadowMapDepth",G.map.depthTexture.format=Un,G.map.depthTexture.compareFunction=null,G.map.depthTexture.minFilter=wt,G.map.depthTexture.magFilter=wt}else W.isPointLight?(G.map=new lr(i.x),G.map.depthTexture=new ks(i.x,dn)):(G.map=new $t(i.x,i.y),G.map.depthTexture=new zn(i.x,i.y,dn)),G.map.depthTexture.name=W.name+".shadowMap",G.map.depthTexture.format=Un,this.type===vi?(G.map.depthTexture.compareFunction=X?Cc:Rc,G.map.depthTexture.minFilter=kt,G.map.depthTexture.magFilter=kt):(G.map.depthTexture.compareFunction=null,G.map.depthTexture.minFilter=wt,G.map.depthTexture.magFilter=wt);G.camera.updateProjectionMatrix()}G.map.isWebGLCubeRenderTarget!==!0&&(G.map.width!==i.x||G.map.height!==i.y)&&G.map.setSize(i.x,i.y);let Q=G.map.isWebGLCubeRenderTarget?6:G.getViewportCount();W.isPointLight!==!0&&G.updateMatrices(W,S);let te=(G.camera.layers.mask&4294967294)!==0?G.camera.layers:S.layers;for(let Me=0;Me<Q;Me++){let Fe=G.getCamera(Me);if(W.isPointLight){let J=G.camera,me=G.matrix,ve=W.distance||J.far;ve!==J.far&&(J.far=ve,J.updateProjectionMatrix()),or.setFromMatrixPosition(W.matrixWorld),J.position.copy(or),kc.copy(J.position),kc.add(lx[Me]),J.up.copy(cx[Me]),J.lookAt(kc),J.updateMatrixWorld(),me.makeTranslation(-or.x,-or.y,-or.z),vd.multiplyMatrices(J.projectionMatrix,J.matrixWorldInverse),G._frustum.setFromProjectionMatrix(vd,J.coordinateSystem,J.reversedDepth)}if(G.map.isWebGLCubeRenderTarget)s.setRenderTarget(G.map,Me),s.clear();else{Me===0&&(s.setRenderTarget(G.map),s.clear());let J=G.getViewport(Me);o.set(r.x*J.x,r.y*J.y,r.x*J.z,r.y*J.w),O.viewport(o)}n=G.getFrustum(Me),E(y,S,Fe,W,te,this.type)}G.isPointLightShadow!==!0&&this.type===ss&&b(G,S),G.needsUpdate=!1}m=this.type,p.needsUpdate=!1,s.setRenderTarget(I,R,N)};function b(w,y){let S=e.update(x);f.defines.VSM_SAMPLES!==w.blurSamples&&(f.defines.VSM_SAMPLES=w.blurSamples,d.defines.VSM_SAMPLES=w.blurSamples,f.needsUpdate=!0,d.needsUpdate=!0),w.mapPass===null?w.mapPass=new $t(i.x,i.y,{format:ci,type:pn}):(w.mapPass.width!==w.map.width||w.mapPass.height!==w.map.height)&&w.mapPass.setSize(w.map.width,w.map.height),f.uniforms.shadow_pass.value=w.map.depthTexture,f.uniforms.resolution.value.set(w.map.width,w.map.height),f.uniforms.radius.value=w.radius,s.setRenderTarget(w.mapPass),s.clear(),s.renderBufferDirect(y,null,S,f,x,null),d.uniforms.shadow_pass.value=w.mapPass.texture,d.uniforms.resolution.value.set(w.map.width,w.map.height),d.uniforms.radius.value=w.radius,s.setRenderTarget(w.map),s.clear(),s.renderBufferDirect(y,null,S,d,x,null)}function T(w,y,S,I){let R=null,N=S.isPointLight===!0?w.customDistanceMaterial:w.customDepthMaterial;if(N!==void 0)R=N;else if(R=S.isPointLight===!0?l:a,s.localClippingEnabled&&y.clipShadows===!0&&Array.isArray(y.clippingPlanes)&&y.clippingPlanes.length!==0||y.displacementMap&&y.displacementScale!==0||y.alphaMap&&y.alphaTest>0||y.map&&y.alphaTest>0||y.alphaToCoverage===!0){let O=R.uuid,D=y.uuid,P=c[O];P===void 0&&(P={},c[O]=P);let V=P[D];V===void 0&&(V=R.clone(),P[D]=V,y.addEventListener("dispose",M)),R=V}if(R.visible=y.visible,R.wireframe=y.wireframe,I===ss?R.side=y.shadowSide!==null?y.shadowSide:y.side:R.side=y.shadowSide!==null?y.shadowSide:u[y.side],R.alphaMap=y.alphaMap,R.alphaTest=y.alphaToCoverage===!0?.5:y.alphaTest,R.map=y.map,R.clipShadows=y.clipShadows,R.clippingPlanes=y.clippingPlanes,R.clipIntersection=y.clipIntersection,R.displacementMap=y.displacementMap,R.displacementScale=y.displacementScale,R.displacementBias=y.displacementBias,R.wireframeLinewidth=y.wireframeLinewidth,R.linewidth=y.linewidth,S.isPointLight===!0&&R.isMeshDistanceMaterial===!0){let O=s.properties.get(R);O.light=S}return R}function E(w,y,S,I,R,N){if(w.visible===!1)return;if(w.layers.test(R)&&(w.isMesh||w.isLine||w.isPoints)&&(w.castShadow||w.receiveShadow&&N===ss)&&(!w.frustumCulled||w.intersectsFrustum(n))){w.modelViewMatrix.multiplyMatrices(S.matrixWorldInverse,w.matrixWorld);let P=e.update(w),V=w.material;if(Array.isArray(V)){let W=P.groups;for(let G=0,ee=W.length;G<ee;G++){let X=W[G],Q=V[X.materialIndex];if(Q&&Q.visible){let te=T(w,Q,I,N);w.onBeforeShadow(s,w,y,S,P,te,X),s.renderBufferDirect(S,null,P,te,w,X),w.onAfterShadow(s,w,y,S,P,te,X)}}}else if(V.visible){let W=T(w,V,I,N);w.onBeforeShadow(s,w,y,S,P,W,null),s.renderBufferDirect(S,null,P,W,w,null),w.onAfterShadow(s,w,y,S,P,W,null)}}let D=w.children;for(let P=0,V=D.length;P<V;P++)E(D[P],y,S,I,R,N)}function M(w){w.target.removeEventListener("dispose",M);for(let S in c){let I=c[S],R=w.target.uuid;R in I&&(I[R].dispose(),delete I[R])}}}function ux(s,e){function t(){let C=!1,K=new at,q=null,le=new at(0,0,0,0);return{setMask:function(se){q!==se&&!C&&(s.colorMask(se,se,se,se),q=se)},setLocked:function(se){C=se},setClear:function(se,oe,we,ze,ie){ie===!0&&(se*=ze,oe*=ze,we*=ze),K.set(se,oe,we,ze),le.equals(K)===!1&&(s.clearColor(se,oe,we,ze),le.copy(K))},reset:function(){C=!1,q=null,le.set(-1,0,0,0)}}}function n(){let C=!1,K=!1,q=null,le=null,se=null;return{setReversed:function(oe){if(K!==oe){let we=e.get("EXT_clip_control");oe?we.clipControlEXT(we.LOWER_LEFT_EXT,we.ZERO_TO_ONE_EXT):we.clipControlEXT(we.LOWER_LEFT_EXT,we.NEGATIVE_ONE_TO_ONE_EXT),K=oe;let ze=se;se=null,this.setClear(ze)}},getReversed:function(){return K},setTest:function(oe){oe?ge(s.DEPTH_TEST):Oe(s.DEPTH_TEST)},setMask:function(oe){q!==oe&&!C&&(s.depthMask(oe),q=oe)},setFunc:function(oe){if(K&&(oe=Yu[oe]),le!==oe){switch(oe){case fo:s.depthFunc(s.NEVER);break;case po:s.depthFunc(s.ALWAYS);break;case mo:s.depthFunc(s.LESS);break;case $i:s.depthFunc(s.LEQUAL);break;case go:s.depthFunc(s.EQUAL);break;case yo:s.depthFunc(s.GEQUAL);break;case xo:s.depthFunc(s.GREATER);break;case vo:s.depthFunc(s.NOTEQUAL);break;default:s.depthFunc(s.LEQUAL)}le=oe}},setLocked:function(oe){C=oe},setClear:function(oe){se!==oe&&(se=oe,K&&(oe=1-oe),s.clearDepth(oe))},reset:function(){C=!1,q=null,le=null,se=null,K=!1}}}function i(){let C=!1,K=null,q=null,le=null,se=null,oe=null,we=null,ze=null,ie=null;return{setTest:function(Ee){C||(Ee?ge(s.STENCIL_TEST):Oe(s.STENCIL_TEST))},setMask:function(Ee){K!==Ee&&!C&&(s.stencilMask(Ee),K=Ee)},setFunc:function(Ee,ke,fe){(q!==Ee||le!==ke||se!==fe)&&(s.stencilFunc(Ee,ke,fe),q=Ee,le=ke,se=fe)},setOp:function(Ee,ke,fe){(oe!==Ee||we!==ke||ze!==fe)&&(s.stencilOp(Ee,ke,fe),oe=Ee,we=ke,ze=fe)},setLocked:function(Ee){C=Ee},setClear:function(Ee){ie!==Ee&&(s.clearStencil(Ee),ie=Ee)},reset:function(){C=!1,K=null,q=null,le=null,se=null,oe=null,we=null,ze=null,ie=null}}}let r=new t,o=new n,a=new i,l={},c=new WeakMap,h={},u={},f={},d=new WeakMap,g=[],x=null,p=!1,m=null,b=null,T=null,E=null,M=null,w=null,y=null,S=new Ie(0,0,0),I=0,R=!1,N=null,O=null,D=null,P=null,V=null,W=s.getParameter(s.MAX_COMBINED_TEXTURE_IMAGE_UNITS),G=!1,ee=0,X=s.getParameter(s.VERSION);X.indexOf("WebGL")!==-1?(ee=parseFloat(/^WebGL (\d)/.exec(X)[1]),G=ee>=1):X.indexOf("OpenGL ES")!==-1&&(ee=parseFloat(/^OpenGL ES (\d)/.exec(X)[1]),G=ee>=2);let Q=null,te={},Me=s.getParameter(s.SCISSOR_BOX),Fe=s.getParameter(s.VIEWPORT),J=new at().fromArray(Me),me=new at().fromArray(Fe);function ve(C,K,q,le){let se=new Uint8Array(4),oe=s.createTexture();s.bindTexture(C,oe),s.texParameteri(C,s.TEXTURE_MIN_FILTER,s.NEAREST),s.texParameteri(C,s.TEXTURE_MAG_FILTER,s.NEAREST);for(let we=0;we<q;we++)C===s.TEXTURE_3D||C===s.TEXTURE_2D_ARRAY?s.texImage3D(K,0,s.RGBA,1,1,le,0,s.RGBA,s.UNSIGNED_BYTE,se):s.texImage2D(K+we,0,s.RGBA,1,1,0,s.RGBA,s.UNSIGNED_BYTE,se);return oe}let Te={};Te[s.TEXTURE_2D]=ve(s.TEXTURE_2D,s.TEXTURE_2D,1),Te[s.TEXTURE_CUBE_MAP]=ve(s.TEXTURE_CUBE_MAP,s.TEXTURE_CUBE_MAP_POSITIVE_X,6),Te[s.TEXTURE_2D_ARRAY]=ve(s.TEXTURE_2D_ARRAY,s.TEXTURE_2D_ARRAY,1,1),Te[s.TEXTURE_3D]=ve(s.TEXTURE_3D,s.TEXTURE_3D,1,1),r.setClear(0,0,0,1),o.setClear(1),a.setClear(0),ge(s.DEPTH_TEST),o.setFunc($i),zt(!1),lt(ac),ge(s.CULL_FACE),At(_i);function ge(C){h[C]!==!0&&(s.enable(C),h[C]=!0)}function Oe(C){h[C]!==!1&&(s.disable(C),h[C]=!1)}function dt(C,K){return f[C]!==K?(s.bindFramebuffer(C,K),f[C]=K,C===s.DRAW_FRAMEBUFFER&&(f[s.FRAMEBUFFER]=K),C===s.FRAMEBUFFER&&(f[s.DRAW_FRAMEBUFFER]=K),!0):!1}function Pe(C,K){let q=g,le=!1;if(C){q=d.get(K),q===void 0&&(q=[],d.set(K,q));let se=C.textures;if(q.length!==se.length||q[0]!==s.COLOR_ATTACHMENT0){for(let oe=0,we=se.length;oe<we;oe++)q[oe]=s.COLOR_ATTACHMENT0+oe;q.length=se.length,le=!0}}else q[0]!==s.BACK&&(q[0]=s.BACK,le=!0);le&&s.drawBuffers(q)}function Je(C){return x!==C?(s.useProgram(C),x=C,!0):!1}let Qe={[bi]:s.FUNC_ADD,[mu]:s.FUNC_SUBTRACT,[gu]:s.FUNC_REVERSE_SUBTRACT};Qe[yu]=s.MIN,Qe[xu]=s.MAX;let Ge={[vu]:s.ZERO,[_u]:s.ONE,[bu]:s.SRC_COLOR,[uc]:s.SRC_ALPHA,[Tu]:s.SRC_ALPHA_SATURATE,[Eu]:s.DST_COLOR,[Su]:s.DST_ALPHA,[Mu]:s.ONE_MINUS_SRC_COLOR,[dc]:s.ONE_MINUS_SRC_ALPHA,[Au]:s.ONE_MINUS_DST_COLOR,[wu]:s.ONE_MINUS_DST_ALPHA,[Ru]:s.CONSTANT_COLOR,[Cu]:s.ONE_MINUS_CONSTANT_COLOR,[Pu]:s.CONSTANT_ALPHA,[Iu]:s.ONE_MINUS_CONSTANT_ALPHA};function At(C,K,q,le,se,oe,we,ze,ie,Ee){if(C===_i){p===!0&&(Oe(s.BLEND),p=!1);return}if(p===!1&&(ge(s.BLEND),p=!0),C!==pu){if(C!==m||Ee!==R){if((b!==bi||M!==bi)&&(s.blendEquation(s.FUNC_ADD),b=bi,M=bi),Ee)switch(C){case rs:s.blendFuncSeparate(s.ONE,s.ONE_MINUS_SRC_ALPHA,s.ONE,s.ONE_MINUS_SRC_ALPHA);break;case lc:s.blendFunc(s.ONE,s.ONE);break;case cc:s.blendFuncSeparate(s.ZERO,s.ONE_MINUS_SRC_COLOR,s.ZERO,s.ONE);break;case hc:s.blendFuncSeparate(s.DST_COLOR,s.ONE_MINUS_SRC_ALPHA,s.ZERO,s.ONE);break;default:Le("WebGLState: Invalid blending: ",C);break}else switch(C){case rs:s.blendFuncSeparate(s.SRC_ALPHA,s.ONE_MINUS_SRC_ALPHA,s.ONE,s.ONE_MINUS_SRC_ALPHA);break;case lc:s.blendFuncSeparate(s.SRC_ALPHA,s.ONE,s.ONE,s.ONE);break;case cc:Le("WebGLState: SubtractiveBlending requires material.premultipliedAlpha = true");break;case hc:Le("WebGLState: MultiplyBlending requires material.premultipliedAlpha = true");break;default:Le("WebGLState: Invalid blending: ",C);break}T=null,E=null,w=null,y=null,S.set(0,0,0),I=0,m=C,R=Ee}return}se=se||K,oe=oe||q,we=we||le,(K!==b||se!==M)&&(s.blendEquationSeparate(Qe[K],Qe[se]),b=K,M=se),(q!==T||le!==E||oe!==w||we!==y)&&(s.blendFuncSeparate(Ge[q],Ge[le],Ge[oe],Ge[we]),T=q,E=le,w=oe,y=we),(ze.equals(S)===!1||ie!==I)&&(s.blendColor(ze.r,ze.g,ze.b,ie),S.copy(ze),I=ie),m=C,R=!1}function mt(C,K){C.side===Gt?Oe(s.CULL_FACE):ge(s.CULL_FACE);let q=C.side===Ct;K&&(q=!q),zt(q),C.blending===rs&&C.transparent===!1?At(_i):At(C.blending,C.blendEquation,C.blendSrc,C.blendDst,C.blendEquationAlpha,C.blendSrcAlpha,C.blendDstAlpha,C.blendColor,C.blendAlpha,C.premultipliedAlpha),o.setFunc(C.depthFunc),o.setTest(C.depthTest),o.setMask(C.depthWrite),r.setMask(C.colorWrite);let le=C.stencilWrite;a.setTest(le),le&&(a.setMask(C.stencilWriteMask),a.setFunc(C.stencilFunc,C.stencilRef,C.stencilFuncMask),a.setOp(C.stencilFail,C.stencilZFail,C.stencilZPass)),vt(C.polygonOffset,C.polygonOffsetFactor,C.polygonOffsetUnits),C.alphaToCoverage===!0?ge(s.SAMPLE_ALPHA_TO_COVERAGE):Oe(s.SAMPLE_ALPHA_TO_COVERAGE)}function zt(C){N!==C&&(C?s.frontFace(s.CW):s.frontFace(s.CCW),N=C)}function lt(C){C!==uu?(ge(s.CULL_FACE),C!==O&&(C===ac?s.cullFace(s.BACK):C===du?s.cullFace(s.FRONT):s.cullFace(s.FRONT_AND_BACK))):Oe(s.CULL_FACE),O=C}function yn(C){C!==D&&(G&&s.lineWidth(C),D=C)}function vt(C,K,q){C?(ge(s.POLYGON_OFFSET_FILL),(P!==K||V!==q)&&(P=K,V=q,o.getReversed()&&(K=-K,q=-q),s.polygonOffset(K,q))):Oe(s.POLYGON_OFFSET_FILL)}function Jt(C){C?ge(s.SCISSOR_TEST):Oe(s.SCISSOR_TEST)}function Kt(C){C===void 0&&(C=s.TEXTURE0+W-1),Q!==C&&(s.activeTexture(C),Q=C)}function jt(C,K,q){q===void 0&&(Q===null?q=s.TEXTURE0+W-1:q=Q);let le=te[q];le===void 0&&(le={type:void 0,texture:void 0},te[q]=le),(le.type!==C||le.texture!==K)&&(Q!==q&&(s.activeTexture(q),Q=q),s.bindTexture(C,K||Te[C]),le.type=C,le.texture=K)}function F(){let C=te[Q];C!==void 0&&C.type!==void 0&&(s.bindTexture(C.type,null),C.type=void 0,C.texture=void 0)}function Qt(){try{s.compressedTexImage2D(...arguments)}catch(C){Le("WebGLState:",C)}}function rt(){try{s.compressedTexImage3D(...arguments)}catch(C){Le("WebGLState:",C)}}function ot(){try{s.texSubImage2D(...arguments)}catch(C){Le("WebGLState:",C)}}function de(){try{s.texSubImage3D(...arguments)}catch(C){Le("WebGLState:",C)}}function gt(){try{s.compressedTexSubImage2D(...arguments)}catch(C){Le("WebGLState:",C)}}function Re(){try{s.compressedTexSubImage3D(...arguments)}catch(C){Le("WebGLState:",C)}}function De(){try{s.texStorage2D(...arguments)}catch(C){Le("WebGLState:",C)}}function A(){try{s.texStorage3D(...arguments)}catch(C){Le("WebGLState:",C)}}function v(){try{s.texImage2D(...arguments)}catch(C){Le("WebGLState:",C)}}function k(){try{s.texImage3D(...arguments)}catch(C){Le("WebGLState:",C)}}function ne(C){return u[C]!==void 0?u[C]:s.getParameter(C)}function j(C,K){u[C]!==K&&(s.pixelStorei(C,K),u[C]=K)}function re(C){J.equals(C)===!1&&(s.scissor(C.x,C.y,C.z,C.w),J.copy(C))}function he(C){me.equals(C)===!1&&(s.viewport(C.x,C.y,C.z,C.w),me.copy(C))}function Y(C,K){let q=c.get(K);q===void 0&&(q=new WeakMap,c.set(K,q));let le=q.get(C);le===void 0&&(le=s.getUniformBlockIndex(K,C.name),s.uniformBlockBinding(K,le,le),q.set(C,le))}function $(C,K,q){let se=c.get(K).get(C);l[se]!==q&&(s.bindBufferBase(s.UNIFORM_BUFFER,se,q),l[se]=q)}function ae(){s.disable(s.BLEND),s.disable(s.CULL_FACE),s.disable(s.DEPTH_TEST),s.disable(s.POLYGON_OFFSET_FILL),s.disable(s.SCISSOR_TEST),s.disable(s.STENCIL_TEST),s.disable(s.SAMPLE_ALPHA_TO_COVERAGE),s.blendEquation(s.FUNC_ADD),s.blendFunc(s.ONE,s.ZERO),s.blendFuncSeparate(s.ONE,s.ZERO,s.ONE,s.ZERO),s.blendColor(0,0,0,0),s.colorMask(!0,!0,!0,!0),s.clearColor(0,0,0,0),s.depthMask(!0),s.depthFunc(s.LESS),o.setReversed(!1),s.clearDepth(1),s.stencilMask(4294967295),s.stencilFunc(s.ALWAYS,0,4294967295),s.stencilOp(s.KEEP,s.KEEP,s.KEEP),s.clearStencil(0),s.cullFace(s.BACK),s.frontFace(s.CCW),s.polygonOffset(0,0),s.activeTexture(s.TEXTURE0),s.bindFramebuffer(s.FRAMEBUFFER,null),s.bindFramebuffer(s.DRAW_FRAMEBUFFER,null),s.bindFramebuffer(s.READ_FRAMEBUFFER,null),s.useProgram(null),s.lineWidth(1),s.scissor(0,0,s.canvas.width,s.canvas.height),s.viewport(0,0,s.canvas.width,s.canvas.height),s.pixelStorei(s.PACK_ALIGNMENT,4),s.pixelStorei(s.UNPACK_ALIGNMENT,4),s.pixelStorei(s.UNPACK_FLIP_Y_WEBGL,!1),s.pixelStorei(s.UNPACK_PREMULTIPLY_ALPHA_WEBGL,!1),s.pixelStorei(s.UNPACK_COLORSPACE_CONVERSION_WEBGL,s.BROWSER_DEFAULT_WEBGL),s.pixelStorei(s.PACK_ROW_LENGTH,0),s.pixelStorei(s.PACK_SKIP_PIXELS,0),s.pixelStorei(s.PACK_SKIP_ROWS,0),s.pixelStorei(s.UNPACK_ROW_LENGTH,0),s.pixelStorei(s.UNPACK_IMAGE_HEIGHT,0),s.pixelStorei(s.UNPACK_SKIP_PIXELS,0),s.pixelStorei(s.UNPACK_SKIP_ROWS,0),s.pixelStorei(s.UNPACK_SKIP_IMAGES,0),h={},u={},Q=null,te={},f={},l={},d=new WeakMap,g=[],x=null,p=!1,m=null,b=null,T=null,E=null,M=null,w=null,y=null,S=new Ie(0,0,0),I=0,R=!1,N=null,O=null,D=null,P=null,V=null,J.set(0,0,s.canvas.width,s.canvas.height),me.set(0,0,s.canvas.width,s.canvas.height),r.reset(),o.reset(),a.reset()}return{buffers:{color:r,depth:o,stencil:a},enable:ge,disable:Oe,bindFramebuffer:dt,drawBuffers:Pe,useProgram:Je,setBlending:At,setMaterial:mt,setFlipSided:zt,setCullFace:lt,setLineWidth:yn,setPolygonOffset:vt,setScissorTest:Jt,activeTexture:Kt,bindTexture:jt,unbindTexture:F,compressedTexImage2D:Qt,compressedTexImage3D:rt,texImage2D:v,texImage3D:k,pixelStorei:j,getParameter:ne,updateUBOMapping:Y,uniformBlockBinding:$,texStorage2D:De,texStorage3D:A,texSubImage2D:ot,texSubImage3D:de,compressedTexSubImage2D:gt,compressedTexSubImage3D:Re,scissor:re,viewport:he,reset:ae}}function dx(s,e,t,n,i,r,o){let a=e.has("WEBGL_multisampled_render_to_texture")?e.get("WEBGL_multisampled_render_to_texture"):null,l=typeof navigator>"u"?!1:/OculusBrowser/g.test(navigator.userAgent),c=new Be,h=new WeakMap,u=new Set,f,d=new WeakMap,g=new Set,x=new FinalizationRegistry(A=>g.delete(A)),p=!1;try{p=typeof OffscreenCanvas<"u"&&new OffscreenCanvas(1,1).getContext("2d")!==null}catch{}function m(A,v){return p?new OffscreenCanvas(A,v):Ps("canvas")}function b(A,v,k){let ne=1,j=De(A);if((j.width>k||j.height>k)&&(ne=k/Math.max(j.width,j.height)),ne<1)if(typeof HTMLImageElement<"u"&&A instanceof HTMLImageElement||typeof HTMLCanvasElement<"u"&&A instanceof HTMLCanvasElement||typeof ImageBitmap<"u"&&A instanceof ImageBitmap||typeof VideoFrame<"u"&&A instanceof VideoFrame){let re=Math.floor(ne*j.width),he=Math.floor(ne*j.height);f===void 0&&(f=m(re,he));let Y=v?m(re,he):f;return Y.width=re,Y.height=he,Y.getContext("2d").drawImage(A,0,0,re,he),Ce("WebGLRenderer: Texture has been resized from ("+j.width+"x"+j.height+") to ("+re+"x"+he+")."),Y}else return"data"in A&&Ce("WebGLRenderer: Image in DataTexture is too big ("+j.width+"x"+j.height+")."),A;return A}function T(A){return A.generateMipmaps}function E(A){s.generateMipmap(A)}function M(A){return A.isWebGLCubeRenderTarget?s.TEXTURE_CUBE_MAP:A.isWebGL3DRenderTarget?s.TEXTURE_3D:A.isWebGLArrayRenderTarget||A.isCompressedArrayTexture?s.TEXTURE_2D_ARRAY:s.TEXTURE_2D}function w(A,v,k,ne,j,re=!1){if(A!==null){if(s[A]!==void 0)return s[A];Ce("WebGLRenderer: Attempt to use non-existing WebGL internal format '"+A+"'")}let he;ne&&(he=e.get("EXT_texture_norm16"),he||Ce("WebGLRenderer: Unable to use normalized textures without EXT_texture_norm16 extension"));let Y=v;if(v===s.RED&&(k===s.FLOAT&&(Y=s.R32F),k===s.HALF_FLOAT&&(Y=s.R16F),k===s.UNSIGNED_BYTE&&(Y=s.R8),k===s.UNSIGNED_SHORT&&he&&(Y=he.R16_EXT),k===s.SHORT&&he&&(Y=he.R16_SNORM_EXT)),v===s.RED_INTEGER&&(k===s.UNSIGNED_BYTE&&(Y=s.R8UI),k===s.UNSIGNED_SHORT&&(Y=s.R16UI),k===s.UNSIGNED_INT&&(Y=s.R32UI),k===s.BYTE&&(Y=s.R8I),k===s.SHORT&&(Y=s.R16I),k===s.INT&&(Y=s.R32I)),v===s.RG&&(k===s.FLOAT&&(Y=s.RG32F),k===s.HALF_FLOAT&&(Y=s.RG16F),k===s.UNSIGNED_BYTE&&(Y=s.RG8),k===s.UNSIGNED_SHORT&&he&&(Y=he.RG16_EXT),k===s.SHORT&&he&&(Y=he.RG16_SNORM_EXT)),v===s.RG_INTEGER&&(k===s.UNSIGNED_BYTE&&(Y=s.RG8UI),k===s.UNSIGNED_SHORT&&(Y=s.RG16UI),k===s.UNSIGNED_INT&&(Y=s.RG32UI),k===s.BYTE&&(Y=s.RG8I),k===s.SHORT&&(Y=s.RG16I),k===s.INT&&(Y=s.RG32I)),v===s.RGB_INTEGER&&(k===s.UNSIGNED_BYTE&&(Y=s.RGB8UI),k===s.UNSIGNED_SHORT&&(Y=s.RGB16UI),k===s.UNSIGNED_INT&&(Y=s.RGB32UI),k===s.BYTE&&(Y=s.RGB8I),k===s.SHORT&&(Y=s.RGB16I),k===s.INT&&(Y=s.RGB32I)),v===s.RGBA_INTEGER&&(k===s.UNSIGNED_BYTE&&(Y=s.RGBA8UI),k===s.UNSIGNED_SHORT&&(Y=s.RGBA16UI),k===s.UNSIGNED_INT&&(Y=s.RGBA32UI),k===s.BYTE&&(Y=s.RGBA8I),k===s.SHORT&&(Y=s.RGBA16I),k===s.INT&&(Y=s.RGBA32I)),v===s.RGB&&(k===s.UNSIGNED_SHORT&&he&&(Y=he.RGB16_EXT),k===s.SHORT&&he&&(Y=he.RGB16_SNORM_EXT),k===s.UNSIGNED_INT_5_9_9_9_REV&&(Y=s.RGB9_E5),k===s.UNSIGNED_INT_10F_11F_11F_REV&&(Y=s.R11F_G11F_B10F)),v===s.RGBA){let $=re?Cs:Xe.getTransfer(j);k===s.FLOAT&&(Y=s.RGBA32F),k===s.HALF_FLOAT&&(Y=s.RGBA16F),k===s.UNSIGNED_BYTE&&(Y=$===Ze?s.SRGB8_ALPHA8:s.RGBA8),k===s.UNSIGNED_SHORT&&he&&(Y=he.RGBA16_EXT),k===s.SHORT&&he&&(Y=he.RGBA16_SNORM_EXT),k===s.UNSIGNED_SHORT_4_4_4_4&&(Y=s.RGBA4),k===s.UNSIGNED_SHORT_5_5_5_1&&(Y=s.RGB5_A1)}return(Y===s.R16F||Y===s.R32F||Y===s.RG16F||Y===s.RG32F||Y===s.RGBA16F||Y===s.RGBA32F)&&e.get("EXT_color_buffer_float"),Y}function y(A,v){let k;return A?v===null||v===dn||v===Si?k=s.DEPTH24_STENCIL8:v===fn?k=s.DEPTH32F_STENCIL8:v===as&&(k=s.DEPTH24_STENCIL8,Ce("DepthTexture: 16 bit depth attachment is not supported with stencil. Using 24-bit attachment.")):v===null||v===dn||v===Si?k=s.DEPTH_COMPONENT24:v===fn?k=s.DEPTH_COMPONENT32F:v===as&&(k=s.DEPTH_COMPONENT16),k}function S(A,v){return T(A)===!0||A.isFramebufferTexture&&A.minFilter!==wt&&A.minFilter!==kt?Math.log2(Math.max(v.width,v.height))+1:A.mipmaps.length>0?A.mipmaps.length:A.isCompressedTexture&&Array.isArray(A.image)?v.mipmaps.length:1}function I(A){let v=new WeakRef(A);n.get(A).__ref=v,g.add(v),x.register(A,v,v)}function R(A){let v=n.get(A).__ref;v!==void 0&&(g.delete(v),x.unregister(v))}function N(A){D(A.target)}function O(A){P(A.target)}function D(A){A.removeEventListener("dispose",N),R(A),W(A),A.isVideoTexture&&h.delete(A),A.isHTMLTexture&&u.delete(A)}function P(A){A.removeEventListener("dispose",O),R(A),ee(A)}function V(){for(let A of g){let v=A.deref();v!==void 0&&(v.isRenderTarget===!0?P(v):D(v))}g.clear(),u.clear()}function W(A){let v=n.get(A);if(v.__webglInit===void 0)return;let k=A.source,ne=d.get(k);if(ne){let j=ne[v.__cacheKey];j.usedTimes--,j.usedTimes===0&&G(A),Object.keys(ne).length===0&&d.delete(k)}n.remove(A)}function G(A){let v=n.get(A);s.deleteTexture(v.__webglTexture);let k=A.source,ne=d.get(k);delete ne[v.__cacheKey],o.memory.textures--}function ee(A){let v=n.get(A);v.__depthDisposeCallback&&v.__depthDisposeCallback();let k=A.depthTexture;if(k&&k.renderTarget===A&&D(k),A.isWebGLCubeRenderTarget)for(let j=0;j<6;j++){if(Array.isArray(v.__webglFramebuffer[j]))for(let re=0;re<v.__webglFramebuffer[j].length;re++)s.deleteFramebuffer(v.__webglFramebuffer[j][re]);else s.deleteFramebuffer(v.__webglFramebuffer[j]);v.__webglDepthbuffer&&s.deleteRenderbuffer(v.__webglDepthbuffer[j])}else{if(Array.isArray(v.__webglFramebuffer))for(let j=0;j<v.__webglFramebuffer.length;j++)s.deleteFramebuffer(v.__webglFramebuffer[j]);else s.deleteFramebuffer(v.__webglFramebuffer);if(v.__webglDepthbuffer&&s.deleteRenderbuffer(v.__webglDepthbuffer),v.__webglMultisampledFramebuffer&&s.deleteFramebuffer(v.__webglMultisampledFramebuffer),v.__webglColorRenderbuffer)for(let j=0;j<v.__webglColorRenderbuffer.length;j++)v.__webglColorRenderbuffer[j]&&s.deleteRenderbuffer(v.__webglColorRenderbuffer[j]);v.__webglDepthRenderbuffer&&s.deleteRenderbuffer(v.__webglDepthRenderbuffer)}let ne=A.textures;for(let j=0,re=ne.length;j<re;j++){let he=n.get(ne[j]);he.__webglTexture&&(s.deleteTexture(he.__webglTexture),o.memory.textures--),n.remove(ne[j])}n.remove(A)}let X=0;function Q(){X=0}function te(){return X}function Me(A){X=A}function Fe(){let A=X;return A>=i.maxTextures&&Ce("WebGLTextures: Trying to use "+(A+1)+" texture units while this GPU supports only "+i.maxTextures),X+=1,A}function J(A){let v=[];return v.push(A.wrapS),v.push(A.wrapT),v.push(A.wrapR||0),v.push(A.magFilter),v.push(A.minFilter),v.push(A.anisotropy),v.push(A.internalFormat),v.push(A.format),v.push(A.type),v.push(A.generateMipmaps),v.push(A.mipmapsAutoUpdate),v.push(A.premultiplyAlpha),v.push(A.flipY),v.push(A.unpackAlignment),v.push(A.colorSpace),v.join()}function me(A,v){let k=n.get(A);if(A.isVideoTexture&&gt(A),A.isRenderTargetTexture===!1&&A.isExternalTexture!==!0&&A.version>0&&k.__version!==A.version){let ne=A.image;if(ne===null)Ce("WebGLRenderer: Texture marked for update but no image data found.");else if(ne.complete===!1)Ce("WebGLRenderer: Texture marked for update but image is incomplete");else{mt(k,A,v);return}}else A.isExternalTexture&&(k.__webglTexture=A.sourceTexture?A.sourceTexture:null);t.bindTexture(s.TEXTURE_2D,k.__webglTexture,s.TEXTURE0+v)}function ve(A,v){let k=n.get(A);if(A.isRenderTargetTexture===!1&&A.version>0&&k.__version!==A.version){mt(k,A,v);return}else A.isExternalTexture&&(k.__webglTexture=A.sourceTexture?A.sourceTexture:null);t.bindTexture(s.TEXTURE_2D_ARRAY,k.__webglTexture,s.TEXTURE0+v)}function Te(A,v){let k=n.get(A);if(A.isRenderTargetTexture===!1&&A.version>0&&k.__version!==A.version){mt(k,A,v);return}t.bindTexture(s.TEXTURE_3D,k.__webglTexture,s.TEXTURE0+v)}function ge(A,v){let k=n.get(A);if(A.version>0&&k.__version!==A.version){zt(k,A,v);return}t.bindTexture(s.TEXTURE_CUBE_MAP,k.__webglTexture,s.TEXTURE0+v)}let Oe={[_o]:s.REPEAT,[bn]:s.CLAMP_TO_EDGE,[bo]:s.MIRRORED_REPEAT},dt={[wt]:s.NEAREST,[Du]:s.NEAREST_MIPMAP_NEAREST,[js]:s.NEAREST_MIPMAP_LINEAR,[kt]:s.LINEAR,[Jo]:s.LINEAR_MIPMAP_NEAREST,[Gn]:s.LINEAR_MIPMAP_LINEAR},Pe={[Bu]:s.NEVER,[Pc]:s.ALWAYS,[ku]:s.LESS,[Rc]:s.LEQUAL,[zu]:s.EQUAL,[Cc]:s.GEQUAL,[Vu]:s.GREATER,[Gu]:s.NOTEQUAL};function Je(A,v){if(v.type===fn&&e.has("OES_texture_float_linear")===!1&&(v.magFilter===kt||v.magFilter===Jo||v.magFilter===js||v.magFilter===Gn||v.minFilter===kt||v.minFilter===Jo||v.minFilter===js||v.minFilter===Gn)&&Ce("WebGLRenderer: Unable to use linear filtering with floating point textures. OES_texture_float_linear not supported on this device."),s.texParameteri(A,s.TEXTURE_WRAP_S,Oe[v.wrapS]),s.texParameteri(A,s.TEXTURE_WRAP_T,Oe[v.wrapT]),(A===s.TEXTURE_3D||A===s.TEXTURE_2D_ARRAY)&&s.texParameteri(A,s.TEXTURE_WRAP_R,Oe[v.wrapR]),s.texParameteri(A,s.TEXTURE_MAG_FILTER,dt[v.magFilter]),s.texParameteri(A,s.TEXTURE_MIN_FILTER,dt[v.minFilter]),v.compareFunction&&(s.texParameteri(A,s.TEXTURE_COMPARE_MODE,s.COMPARE_REF_TO_TEXTURE),s.texParameteri(A,s.TEXTURE_COMPARE_FUNC,Pe[v.compareFunction])),e.has("EXT_texture_filter_anisotropic")===!0){if(v.magFilter===wt||v.minFilter!==js&&v.minFilter!==Gn||v.type===fn&&e.has("OES_texture_float_linear")===!1)return;if(v.anisotropy>1||n.get(v).__currentAnisotropy){let k=e.get("EXT_texture_filter_anisotropic");s.texParameterf(A,k.TEXTURE_MAX_ANISOTROPY_EXT,Math.min(v.anisotropy,i.getMaxAnisotropy())),n.get(v).__currentAnisotropy=v.anisotropy}}}function Qe(A,v){let k=!1;A.__webglInit===void 0&&(A.__webglInit=!0,v.addEventListener("dispose",N),I(v));let ne=v.source,j=d.get(ne);j===void 0&&(j={},d.set(ne,j));let re=J(v);if(re!==A.__cacheKey){j[re]===void 0&&(j[re]={texture:s.createTexture(),usedTimes:0},o.memory.textures++,k=!0),j[re].usedTimes++;let he=j[A.__cacheKey];he!==void 0&&(j[A.__cacheKey].usedTimes--,he.usedTimes===0&&G(v)),A.__cacheKey=re,A.__webglTexture=j[re].texture}return k}function Ge(A,v,k){return Math.floor(Math.floor(A/k)/v)}function At(A,v,k,ne){let re=A.updateRanges;if(re.length===0)t.texSubImage2D(s.TEXTURE_2D,0,0,0,v.width,v.height,k,ne,v.data);else{re.sort((C,K)=>C.start-K.start);let he=0;for(let C=1;C<re.length;C++){let K=re[he],q=re[C],le=K.start+K.count,se=Ge(q.start,v.width,4),oe=Ge(K.start,v.width,4);q.start<=le+1&&se===oe&&Ge(q.start+q.count-1,v.width,4)===se?K.count=Math.max(K.count,q.start+q.count-K.start):(++he,re[he]=q)}re.length=he+1;let Y=t.getParameter(s.UNPACK_ROW_LENGTH),$=t.getParameter(s.UNPACK_SKIP_PIXELS),ae=t.getParameter(s.UNPACK_SKIP_ROWS);t.pixelStorei(s.UNPACK_ROW_LENGTH,v.width);for(let C=0,K=re.length;C<K;C++){let q=re[C],le=Math.floor(q.start/4),se=Math.ceil(q.count/4),oe=le%v.width,we=Math.floor(le/v.width),ze=se,ie=1;t.pixelStorei(s.UNPACK_SKIP_PIXELS,oe),t.pixelStorei(s.UNPACK_SKIP_ROWS,we),t.texSubImage2D(s.TEXTURE_2D,0,oe,we,ze,ie,k,ne,v.data)}A.clearUpdateRanges(),t.pixelStorei(s.UNPACK_ROW_LENGTH,Y),t.pixelStorei(s.UNPACK_SKIP_PIXELS,$),t.pixelStorei(s.UNPACK_SKIP_ROWS,ae)}}function mt(A,v,k){let ne=s.TEXTURE_2D;(v.isDataArrayTexture||v.isCompressedArrayTexture)&&(ne=s.TEXTURE_2D_ARRAY),v.isData3DTexture&&(ne=s.TEXTURE_3D);let j=Qe(A,v),re=v.source;t.bindTexture(ne,A.__webglTexture,s.TEXTURE0+k);let he=n.get(re);if(re.version!==he.__version||j===!0){if(t.activeTexture(s.TEXTURE0+k),(typeof ImageBitmap<"u"&&v.image instanceof ImageBitmap)===!1){let ie=Xe.getPrimaries(Xe.workingColorSpace),Ee=v.colorSpace===Wn?null:Xe.getPrimaries(v.colorSpace),ke=v.colorSpace===Wn||ie===Ee?s.NONE:s.BROWSER_DEFAULT_WEBGL;t.pixelStorei(s.UNPACK_FLIP_Y_WEBGL,v.flipY),t.pixelStorei(s.UNPACK_PREMULTIPLY_ALPHA_WEBGL,v.premultiplyAlpha),t.pixelStorei(s.UNPACK_COLORSPACE_CONVERSION_WEBGL,ke)}t.pixelStorei(s.UNPACK_ALIGNMENT,v.unpackAlignment);let $=b(v.image,!1,i.maxTextureSize);$=Re(v,$);let ae=r.convert(v.format,v.colorSpace),C=r.convert(v.type),K=w(v.internalFormat,ae,C,v.normalized,v.colorSpace,v.isVideoTexture);Je(ne,v);let q,le=v.mipmaps,se=v.isVideoTexture!==!0,oe=he.__version===void 0||j===!0,we=re.dataReady,ze=S(v,$);if(v.isDepthTexture)K=y(v.format===Hn,v.type),oe&&(se?t.texStorage2D(s.TEXTURE_2D,1,K,$.width,$.height):t.texImage2D(s.TEXTURE_2D,0,K,$.width,$.height,0,ae,C,null));else if(v.isDataTexture)if(le.length>0){se&&oe&&t.texStorage2D(s.TEXTURE_2D,ze,K,le[0].width,le[0].height);for(let ie=0,Ee=le.length;ie<Ee;ie++)q=le[ie],se?we&&t.texSubImage2D(s.TEXTURE_2D,ie,0,0,q.width,q.height,ae,C,q.data):t.texImage2D(s.TEXTURE_2D,ie,K,q.width,q.height,0,ae,C,q.data);v.generateMipmaps=!1}else se?(oe&&t.texStorage2D(s.TEXTURE_2D,ze,K,$.width,$.height),we&&At(v,$,ae,C)):t.texImage2D(s.TEXTURE_2D,0,K,$.width,$.height,0,ae,C,$.data);else if(v.isCompressedTexture)if(v.isCompressedArrayTexture){se&&oe&&t.texStorage3D(s.TEXTURE_2D_ARRAY,ze,K,le[0].width,le[0].height,$.depth);for(let ie=0,Ee=le.length;ie<Ee;ie++)if(q=le[ie],v.format!==mn)if(ae!==null)if(se){if(we)if(v.layerUpdates.size>0){let ke=Oc(q.width,q.height,v.format,v.type);for(let fe of v.layerUpdates){let Ke=q.data.subarray(fe*ke/q.data.BYTES_PER_ELEMENT,(fe+1)*ke/q.data.BYTES_PER_ELEMENT);t.compressedTexSubImage3D(s.TEXTURE_2D_ARRAY,ie,0,0,fe,q.width,q.height,1,ae,Ke)}}else t.compressedTexSubImage3D(s.TEXTURE_2D_ARRAY,ie,0,0,0,q.width,q.height,$.depth,ae,q.data)}else t.compressedTexImage3D(s.TEXTURE_2D_ARRAY,ie,K,q.width,q.height,$.depth,0,q.data,0,0);else Ce("WebGLRenderer: Attempt to load unsupported compressed texture format in .uploadTexture()");else se?we&&t.texSubImage3D(s.TEXTURE_2D_ARRAY,ie,0,0,0,q.width,q.height,$.depth,ae,C,q.data):t.texImage3D(s.TEXTURE_2D_ARRAY,ie,K,q.width,q.height,$.depth,0,ae,C,q.data);v.layerUpdates.size>0&&v.clearLayerUpdates()}else{se&&oe&&t.texStorage2D(s.TEXTURE_2D,ze,K,le[0].width,le[0].height);for(let ie=0,Ee=le.length;ie<Ee;ie++)q=le[ie],v.format!==mn?ae!==null?se?we&&t.compressedTexSubImage2D(s.TEXTURE_2D,ie,0,0,q.width,q.height,ae,q.data):t.compressedTexImage2D(s.TEXTURE_2D,ie,K,q.width,q.height,0,q.data):Ce("WebGLRenderer: Attempt to load unsupported compressed texture format in .uploadTexture()"):se?we&&t.texSubImage2D(s.TEXTURE_2D,ie,0,0,q.width,q.height,ae,C,q.data):t.texImage2D(s.TEXTURE_2D,ie,K,q.width,q.height,0,ae,C,q.data)}else if(v.isDataArrayTexture)if(se){if(oe&&t.texStorage3D(s.TEXTURE_2D_ARRAY,ze,K,$.width,$.height,$.depth),we)if(v.layerUpdates.size>0){let ie=Oc($.width,$.height,v.format,v.type);for(let Ee of v.layerUpdates){let ke=$.data.subarray(Ee*ie/$.data.BYTES_PER_ELEMENT,(Ee+1)*ie/$.data.BYTES_PER_ELEMENT);t.texSubImage3D(s.TEXTURE_2D_ARRAY,0,0,0,Ee,$.width,$.height,1,ae,C,ke)}v.clearLayerUpdates()}else t.texSubImage3D(s.TEXTURE_2D_ARRAY,0,0,0,0,$.width,$.height,$.depth,ae,C,$.data)}else t.texImage3D(s.TEXTURE_2D_ARRAY,0,K,$.width,$.height,$.depth,0,ae,C,$.data);else if(v.isData3DTexture)se?(oe&&t.texStorage3D(s.TEXTURE_3D,ze,K,$.width,$.height,$.depth),we&&t.texSubImage3D(s.TEXTURE_3D,0,0,0,0,$.width,$.height,$.depth,ae,C,$.data)):t.texImage3D(s.TEXTURE_3D,0,K,$.width,$.height,$.depth,0,ae,C,$.data);else if(v.isFramebufferTexture){if(oe)if(se)t.texStorage2D(s.TEXTURE_2D,ze,K,$.width,$.height);else{let ie=$.width,Ee=$.height;for(let ke=0;ke<ze;ke++)t.texImage2D(s.TEXTURE_2D,ke,K,ie,Ee,0,ae,C,null),ie>>=1,Ee>>=1}}else if(v.isHTMLTexture){if("texElementImage2D"in s){let ie=s.canvas;if(ie.hasAttribute("layoutsubtree")||ie.setAttribute("layoutsubtree","true"),$.parentNode!==ie){ie.appendChild($),u.add(v),ie.onpaint=Ee=>{let ke=Ee.changedElements;for(let fe of u)ke.includes(fe.image)&&(fe.needsUpdate=!0)},ie.requestPaint();return}if(s.texElementImage2D.length===3)s.texElementImage2D(s.TEXTURE_2D,s.RGBA8,$);else{let ke=s.RGBA,fe=s.RGBA,Ke=s.UNSIGNED_BYTE;s.texElementImage2D(s.TEXTURE_2D,0,ke,fe,Ke,$)}s.texParameteri(s.TEXTURE_2D,s.TEXTURE_MIN_FILTER,s.LINEAR),s.texParameteri(s.TEXTURE_2D,s.TEXTURE_WRAP_S,s.CLAMP_TO_EDGE),s.texParameteri(s.TEXTURE_2D,s.TEXTURE_WRAP_T,s.CLAMP_TO_EDGE)}}else if(le.length>0){if(se&&oe){let ie=De(le[0]);t.texStorage2D(s.TEXTURE_2D,ze,K,ie.width,ie.height)}for(let ie=0,Ee=le.length;ie<Ee;ie++)q=le[ie],se?we&&t.texSubImage2D(s.TEXTURE_2D,ie,0,0,ae,C,q):t.texImage2D(s.TEXTURE_2D,ie,K,ae,C,q);v.generateMipmaps=!1}else if(se){if(oe){let ie=De($);t.texStorage2D(s.TEXTURE_2D,ze,K,ie.width,ie.height)}we&&t.texSubImage2D(s.TEXTURE_2D,0,0,0,ae,C,$)}else t.texImage2D(s.TEXTURE_2D,0,K,ae,C,$);T(v)&&v.mipmapsAutoUpdate===!0&&E(ne),he.__version=re.version,v.onUpdate&&v.onUpdate(v)}A.__version=v.version}function zt(A,v,k){if(v.image.length!==6)return;let ne=Qe(A,v),j=v.source;t.bindTexture(s.TEXTURE_CUBE_MAP,A.__webglTexture,s.TEXTURE0+k);let re=n.get(j);if(j.version!==re.__version||ne===!0){t.activeTexture(s.TEXTURE0+k);let he=Xe.getPrimaries(Xe.workingColorSpace),Y=v.colorSpace===Wn?null:Xe.getPrimaries(v.colorSpace),$=v.colorSpace===Wn||he===Y?s.NONE:s.BROWSER_DEFAULT_WEBGL;t.pixelStorei(s.UNPACK_FLIP_Y_WEBGL,v.flipY),t.pixelStorei(s.UNPACK_PREMULTIPLY_ALPHA_WEBGL,v.premultiplyAlpha),t.pixelStorei(s.UNPACK_ALIGNMENT,v.unpackAlignment),t.pixelStorei(s.UNPACK_COLORSPACE_CONVERSION_WEBGL,$);let ae=v.isCompressedTexture||v.image[0].isCompressedTexture,C=v.image[0]&&v.image[0].isDataTexture,K=[];for(let fe=0;fe<6;fe++)!ae&&!C?K[fe]=b(v.image[fe],!0,i.maxCubemapSize):K[fe]=C?v.image[fe].image:v.image[fe],K[fe]=Re(v,K[fe]);let q=K[0],le=r.convert(v.format,v.colorSpace),se=r.convert(v.type),oe=w(v.internalFormat,le,se,v.normalized,v.colorSpace),we=v.isVideoTexture!==!0,ze=re.__version===void 0||ne===!0,ie=j.dataReady,Ee=S(v,q);Je(s.TEXTURE_CUBE_MAP,v);let ke;if(v.isDepthTexture){if(oe=y(v.format===Hn,v.type),ze)if(we)t.texStorage2D(s.TEXTURE_CUBE_MAP,1,oe,q.width,q.height);else for(let fe=0;fe<6;fe++)t.texImage2D(s.TEXTURE_CUBE_MAP_POSITIVE_X+fe,0,oe,q.width,q.height,0,le,se,null)}else if(ae){we&&ze&&t.texStorage2D(s.TEXTURE_CUBE_MAP,Ee,oe,q.width,q.height);for(let fe=0;fe<6;fe++){ke=K[fe].mipmaps;for(let Ke=0;Ke<ke.length;Ke++){let _t=ke[Ke];v.format!==mn?le!==null?we?ie&&t.compressedTexSubImage2D(s.TEXTURE_CUBE_MAP_POSITIVE_X+fe,Ke,0,0,_t.width,_t.height,le,_t.data):t.compressedTexImage2D(s.TEXTURE_CUBE_MAP_POSITIVE_X+fe,Ke,oe,_t.width,_t.height,0,_t.data):Ce("WebGLRenderer: Attempt to load unsupported compressed texture format in .setTextureCube()"):we?ie&&t.texSubImage2D(s.TEXTURE_CUBE_MAP_POSITIVE_X+fe,Ke,0,0,_t.width,_t.height,le,se,_t.data):t.texImage2D(s.TEXTURE_CUBE_MAP_POSITIVE_X+fe,Ke,oe,_t.width,_t.height,0,le,se,_t.data)}}}else{if(ke=v.mipmaps,we&&ze){ke.length>0&&Ee++;let fe=De(K[0]);t.texStorage2D(s.TEXTURE_CUBE_MAP,Ee,oe,fe.width,fe.height)}for(let fe=0;fe<6;fe++)if(C){we?ie&&t.texSubImage2D(s.TEXTURE_CUBE_MAP_POSITIVE_X+fe,0,0,0,K[fe].width,K[fe].height,le,se,K[fe].data):t.texImage2D(s.TEXTURE_CUBE_MAP_POSITIVE_X+fe,0,oe,K[fe].width,K[fe].height,0,le,se,K[fe].data);for(let Ke=0;Ke<ke.length;Ke++){let Xn=ke[Ke].image[fe].image;we?ie&&t.texSubImage2D(s.TEXTURE_CUBE_MAP_POSITIVE_X+fe,Ke+1,0,0,Xn.width,Xn.height,le,se,Xn.data):t.texImage2D(s.TEXTURE_CUBE_MAP_POSITIVE_X+fe,Ke+1,oe,Xn.width,Xn.height,0,le,se,Xn.data)}}else{we?ie&&t.texSubImage2D(s.TEXTURE_CUBE_MAP_POSITIVE_X+fe,0,0,0,le,se,K[fe]):t.texImage2D(s.TEXTURE_CUBE_MAP_POSITIVE_X+fe,0,oe,le,se,K[fe]);for(let Ke=0;Ke<ke.length;Ke++){let _t=ke[Ke];we?ie&&t.texSubImage2D(s.TEXTURE_CUBE_MAP_POSITIVE_X+fe,Ke+1,0,0,le,se,_t.image[fe]):t.texImage2D(s.TEXTURE_CUBE_MAP_POSITIVE_X+fe,Ke+1,oe,le,se,_t.image[fe])}}}T(v)&&v.mipmapsAutoUpdate===!0&&E(s.TEXTURE_CUBE_MAP),re.__version=j.version,v.onUpdate&&v.onUpdate(v)}A.__version=v.version}function lt(A,v,k,ne,j,re){let he=r.convert(k.format,k.colorSpace),Y=r.convert(k.type),$=w(k.internalFormat,he,Y,k.normalized,k.colorSpace),ae=n.get(v),C=n.get(k);if(C.__renderTarget=v,!ae.__hasExternalTextures){let K=Math.max(1,v.width>>re),q=Math.max(1,v.height>>re);j===s.TEXTURE_3D||j===s.TEXTURE_2D_ARRAY?t.texImage3D(j,re,$,K,q,v.depth,0,he,Y,null):t.texImage2D(j,re,$,K,q,0,he,Y,null)}t.bindFramebuffer(s.FRAMEBUFFER,A),de(v)?a.framebufferTexture2DMultisampleEXT(s.FRAMEBUFFER,ne,j,C.__webglTexture,0,ot(v)):(j===s.TEXTURE_2D||j>=s.TEXTURE_CUBE_MAP_POSITIVE_X&&j<=s.TEXTURE_CUBE_MAP_NEGATIVE_Z)&&s.framebufferTexture2D(s.FRAMEBUFFER,ne,j,C.__webglTexture,re),t.bindFramebuffer(s.FRAMEBUFFER,null)}function yn(A,v,k){if(s.bindRenderbuffer(s.RENDERBUFFER,A),v.depthBuffer){let ne=v.depthTexture,j=ne&&ne.isDepthTexture?ne.type:null,re=y(v.stencilBuffer,j),he=v.stencilBuffer?s.DEPTH_STENCIL_ATTACHMENT:s.DEPTH_ATTACHMENT;de(v)?a.renderbufferStorageMultisampleEXT(s.RENDERBUFFER,ot(v),re,v.width,v.height):k?s.renderbufferStorageMultisample(s.RENDERBUFFER,ot(v),re,v.width,v.height):s.renderbufferStorage(s.RENDERBUFFER,re,v.width,v.height),s.framebufferRenderbuffer(s.FRAMEBUFFER,he,s.RENDERBUFFER,A)}else{let ne=v.textures;for(let j=0;j<ne.length;j++){let re=ne[j],he=r.convert(re.format,re.colorSpace),Y=r.convert(re.type),$=w(re.internalFormat,he,Y,re.normalized,re.colorSpace);de(v)?a.renderbufferStorageMultisampleEXT(s.RENDERBUFFER,ot(v),$,v.width,v.height):k?s.renderbufferStorageMultisample(s.RENDERBUFFER,ot(v),$,v.width,v.height):s.renderbufferStorage(s.RENDERBUFFER,$,v.width,v.height)}}s.bindRenderbuffer(s.RENDERBUFFER,null)}function vt(A,v,k){let ne=v.isWebGLCubeRenderTarget===!0;if(t.bindFramebuffer(s.FRAMEBUFFER,A),!(v.depthTexture&&v.depthTexture.isDepthTexture))throw new Error("THREE.WebGLTextures: renderTarget.depthTexture must be an instance of THREE.DepthTexture.");let j=n.get(v.depthTexture);j.__renderTarget=v;let re=ne?v.depthTexture.image[0]:v.depthTexture.image;(!j.__webglTexture||re.width!==v.width||re.height!==v.height)&&(re.width=v.width,re.height=v.height,v.depthTexture.needsUpdate=!0),ne?ge(v.depthTexture,0):me(v.depthTexture,0);let he=j.__webglTexture,Y=ot(v),$=ne?s.TEXTURE_CUBE_MAP_POSITIVE_X+k:s.TEXTURE_2D,ae=v.depthTexture.format===Hn?s.DEPTH_STENCIL_ATTACHMENT:s.DEPTH_ATTACHMENT;if(v.depthTexture.format===Un)de(v)?a.framebufferTexture2DMultisampleEXT(s.FRAMEBUFFER,ae,$,he,0,Y):s.framebufferTexture2D(s.FRAMEBUFFER,ae,$,he,0);else if(v.depthTexture.format===Hn)de(v)?a.framebufferTexture2DMultisampleEXT(s.FRAMEBUFFER,ae,$,he,0,Y):s.framebufferTexture2D(s.FRAMEBUFFER,ae,$,he,0);else throw new Error("THREE.WebGLTextures: Unknown depthTexture format.")}function Jt(A){let v=n.get(A),k=A.isWebGLCubeRenderTarget===!0;if(v.__boundDepthTexture!==A.depthTexture){let ne=A.depthTexture;if(v.__depthDisposeCallback&&v.__depthDisposeCallback(),ne){let j=()=>{delete v.__boundDepthTexture,delete v.__depthDisposeCallback,ne.removeEventListener("dispose",j)};ne.addEventListener("dispose",j),v.__depthDisposeCallback=j}v.__boundDepthTexture=ne}if(A.depthTexture&&!v.__autoAllocateDepthBuffer)if(k)for(let ne=0;ne<6;ne++)vt(v.__webglFramebuffer[ne],A,ne);else A.texture.mipmaps.length>0?vt(v.__webglFramebuffer[0],A,0):vt(v.__webglFramebuffer,A,0);else if(k){v.__webglDepthbuffer=[];for(let ne=0;ne<6;ne++)if(t.bindFramebuffer(s.FRAMEBUFFER,v.__webglFramebuffer[ne]),v.__webglDepthbuffer[ne]===void 0)v.__webglDepthbuffer[ne]=s.createRenderbuffer(),yn(v.__webglDepthbuffer[ne],A,!1);else{let j=A.stencilBuffer?s.DEPTH_STENCIL_ATTACHMENT:s.DEPTH_ATTACHMENT,re=v.__webglDepthbuffer[ne];s.bindRenderbuffer(s.RENDERBUFFER,re),s.framebufferRenderbuffer(s.FRAMEBUFFER,j,s.RENDERBUFFER,re)}}else if(A.texture.mipmaps.length>0?t.bindFramebuffer(s.FRAMEBUFFER,v.__webglFramebuffer[0]):t.bindFramebuffer(s.FRAMEBUFFER,v.__webglFramebuffer),v.__webglDepthbuffer===void 0)v.__webglDepthbuffer=s.createRenderbuffer(),yn(v.__webglDepthbuffer,A,!1);else{let j=A.stencilBuffer?s.DEPTH_STENCIL_ATTACHMENT:s.DEPTH_ATTACHMENT,re=v.__webglDepthbuffer;s.bindRenderbuffer(s.RENDERBUFFER,re),s.framebufferRenderbuffer(s.FRAMEBUFFER,j,s.RENDERBUFFER,re)}t.bindFramebuffer(s.FRAMEBUFFER,null)}function Kt(A,v,k){let ne=n.get(A);v!==void 0&&lt(ne.__webglFramebuffer,A,A.texture,s.COLOR_ATTACHMENT0,s.TEXTURE_2D,0),k!==void 0&&Jt(A)}function jt(A){let v=A.texture,k=n.get(A),ne=n.get(v);A.addEventListener("dispose",O),I(A);let j=A.textures,re=A.isWebGLCubeRenderTarget===!0,he=j.length>1;if(he||(ne.__webglTexture===void 0&&(ne.__webglTexture=s.createTexture()),ne.__version=v.version,o.memory.textures++),re){k.__webglFramebuffer=[];for(let Y=0;Y<6;Y++)if(v.mipmaps.length>0){k.__webglFramebuffer[Y]=[];for(let $=0;$<v.mipmaps.length;$++)k.__webglFramebuffer[Y][$]=s.createFramebuffer()}else k.__webglFramebuffer[Y]=s.createFramebuffer()}else{if(v.mipmaps.length>0){k.__webglFramebuffer=[];for(let Y=0;Y<v.mipmaps.length;Y++)k.__webglFramebuffer[Y]=s.createFramebuffer()}else k.__webglFramebuffer=s.createFramebuffer();if(he)for(let Y=0,$=j.length;Y<$;Y++){let ae=n.get(j[Y]);ae.__webglTexture===void 0&&(ae.__webglTexture=s.createTexture(),o.memory.textures++)}if(A.samples>0&&de(A)===!1){k.__webglMultisampledFramebuffer=s.createFramebuffer(),k.__webglColorRenderbuffer=[],t.bindFramebuffer(s.FRAMEBUFFER,k.__webglMultisampledFramebuffer);for(let Y=0;Y<j.length;Y++){let $=j[Y];k.__webglColorRenderbuffer[Y]=s.createRenderbuffer(),s.bindRenderbuffer(s.RENDERBUFFER,k.__webglColorRenderbuffer[Y]);let ae=r.convert($.format,$.colorSpace),C=r.convert($.type),K=w($.internalFormat,ae,C,$.normalized,$.colorSpace,A.isXRRenderTarget===!0),q=ot(A);s.renderbufferStorageMultisample(s.RENDERBUFFER,q,K,A.width,A.height),s.framebufferRenderbuffer(s.FRAMEBUFFER,s.COLOR_ATTACHMENT0+Y,s.RENDERBUFFER,k.__webglColorRenderbuffer[Y])}s.bindRenderbuffer(s.RENDERBUFFER,null),A.depthBuffer&&(k.__webglDepthRenderbuffer=s.createRenderbuffer(),yn(k.__webglDepthRenderbuffer,A,!0)),t.bindFramebuffer(s.FRAMEBUFFER,null)}}if(re){t.bindTexture(s.TEXTURE_CUBE_MAP,ne.__webglTexture),Je(s.TEXTURE_CUBE_MAP,v);for(let Y=0;Y<6;Y++)if(v.mipmaps.length>0)for(let $=0;$<v.mipmaps.length;$++)lt(k.__webglFramebuffer[Y][$],A,v,s.COLOR_ATTACHMENT0,s.TEXTURE_CUBE_MAP_POSITIVE_X+Y,$);else lt(k.__webglFramebuffer[Y],A,v,s.COLOR_ATTACHMENT0,s.TEXTURE_CUBE_MAP_POSITIVE_X+Y,0);T(v)?E(s.TEXTURE_CUBE_MAP):v.mipmaps.length>0&&s.texParameteri(s.TEXTURE_CUBE_MAP,s.TEXTURE_MAX_LEVEL,v.mipmaps.length-1),t.unbindTexture()}else if(he){for(let Y=0,$=j.length;Y<$;Y++){let ae=j[Y],C=n.get(ae),K=s.TEXTURE_2D;(A.isWebGL3DRenderTarget||A.isWebGLArrayRenderTarget)&&(K=A.isWebGL3DRenderTarget?s.TEXTURE_3D:s.TEXTURE_2D_ARRAY),t.bindTexture(K,C.__webglTexture),Je(K,ae),lt(k.__webglFramebuffer,A,ae,s.COLOR_ATTACHMENT0+Y,K,0),T(ae)&&E(K)}t.unbindTexture()}else{let Y=s.TEXTURE_2D;if((A.isWebGL3DRenderTarget||A.isWebGLArrayRenderTarget)&&(Y=A.isWebGL3DRenderTarget?s.TEXTURE_3D:s.TEXTURE_2D_ARRAY),t.bindTexture(Y,ne.__webglTexture),Je(Y,v),v.mipmaps.length>0)for(let $=0;$<v.mipmaps.length;$++)lt(k.__webglFramebuffer[$],A,v,s.COLOR_ATTACHMENT0,Y,$);else lt(k.__webglFramebuffer,A,v,s.COLOR_ATTACHMENT0,Y,0);T(v)?E(Y):v.mipmaps.length>0&&s.texParameteri(Y,s.TEXTURE_MAX_LEVEL,v.mipmaps.length-1),t.unbindTexture()}A.depthBuffer&&Jt(A)}function F(A){let v=A.textures;for(let k=0,ne=v.length;k<ne;k++){let j=v[k];if(T(j)&&j.mipmapsAutoUpdate===!0){let re=M(A),he=n.get(j).__webglTexture;t.bindTexture(re,he),E(re),t.unbindTexture()}}}let Qt=[];function rt(A){if(A.samples>0){if(de(A)===!1){let v=A.textures,k=A.width,ne=A.height,j=s.COLOR_BUFFER_BIT,re=A.stencilBuffer?s.DEPTH_STENCIL_ATTACHMENT:s.DEPTH_ATTACHMENT,he=n.get(A),Y=v.length>1;if(Y)for(let ae=0;ae<v.length;ae++)t.bindFramebuffer(s.FRAMEBUFFER,he.__webglMultisampledFramebuffer),s.framebufferRenderbuffer(s.FRAMEBUFFER,s.COLOR_ATTACHMENT0+ae,s.RENDERBUFFER,null),t.bindFramebuffer(s.FRAMEBUFFER,he.__webglFramebuffer),s.framebufferTexture2D(s.DRAW_FRAMEBUFFER,s.COLOR_ATTACHMENT0+ae,s.TEXTURE_2D,null,0);t.bindFramebuffer(s.READ_FRAMEBUFFER,he.__webglMultisampledFramebuffer),A.texture.mipmaps.length>0?t.bindFramebuffer(s.DRAW_FRAMEBUFFER,he.__webglFramebuffer[0]):t.bindFramebuffer(s.DRAW_FRAMEBUFFER,he.__webglFramebuffer);for(let ae=0;ae<v.length;ae++){if(A.resolveDepthBuffer&&(A.depthBuffer&&(j|=s.DEPTH_BUFFER_BIT),A.stencilBuffer&&A.resolveStencilBuffer&&(j|=s.STENCIL_BUFFER_BIT)),Y){s.framebufferRenderbuffer(s.READ_FRAMEBUFFER,s.COLOR_ATTACHMENT0,s.RENDERBUFFER,he.__webglColorRenderbuffer[ae]);let C=n.get(v[ae]).__webglTexture;s.framebufferTexture2D(s.DRAW_FRAMEBUFFER,s.COLOR_ATTACHMENT0,s.TEXTURE_2D,C,0)}s.blitFramebuffer(0,0,k,ne,0,0,k,ne,j,s.NEAREST),l===!0&&(Qt.length=0,Qt.push(s.COLOR_ATTACHMENT0+ae),A.depthBuffer&&A.storeMultisampledDepthBuffer===!1&&Qt.push(re),s.invalidateFramebuffer(s.READ_FRAMEBUFFER,Qt))}if(t.bindFramebuffer(s.READ_FRAMEBUFFER,null),t.bindFramebuffer(s.DRAW_FRAMEBUFFER,null),Y)for(let ae=0;ae<v.length;ae++){t.bindFramebuffer(s.FRAMEBUFFER,he.__webglMultisampledFramebuffer),s.framebufferRenderbuffer(s.FRAMEBUFFER,s.COLOR_ATTACHMENT0+ae,s.RENDERBUFFER,he.__webglColorRenderbuffer[ae]);let C=n.get(v[ae]).__webglTexture;t.bindFramebuffer(s.FRAMEBUFFER,he.__webglFramebuffer),s.framebufferTexture2D(s.DRAW_FRAMEBUFFER,s.COLOR_ATTACHMENT0+ae,s.TEXTURE_2D,C,0)}t.bindFramebuffer(s.DRAW_FRAMEBUFFER,he.__webglMultisampledFramebuffer)}else if(A.depthBuffer&&A.storeMultisampledDepthBuffer===!1&&l){let v=A.stencilBuffer?s.DEPTH_STENCIL_ATTACHMENT:s.DEPTH_ATTACHMENT;s.invalidateFramebuffer(s.DRAW_FRAMEBUFFER,[v])}}}function ot(A){return Math.min(i.maxSamples,A.samples)}function de(A){let v=n.get(A);return A.samples>0&&e.has("WEBGL_multisampled_render_to_texture")===!0&&v.__useRenderToTexture!==!1}function gt(A){let v=o.render.frame;h.get(A)!==v&&(h.set(A,v),A.update())}function Re(A,v){let k=A.colorSpace,ne=A.format,j=A.type;return A.isCompressedTexture===!0||A.isVideoTexture===!0||k!==Rs&&k!==Wn&&(Xe.getTransfer(k)===Ze?(ne!==mn||j!==Ht)&&Ce("WebGLTextures: sRGB encoded textures have to use RGBAFormat and UnsignedByteType."):Le("WebGLTextures: Unsupported texture color space:",k)),v}function De(A){return typeof HTMLImageElement<"u"&&A instanceof HTMLImageElement?(c.width=A.naturalWidth||A.width,c.height=A.naturalHeight||A.height):typeof VideoFrame<"u"&&A instanceof VideoFrame?(c.width=A.displayWidth,c.height=A.displayHeight):(c.width=A.width,c.height=A.height),c}this.allocateTextureUnit=Fe,this.resetTextureUnits=Q,this.getTextureUnits=te,this.setTextureUnits=Me,this.setTexture2D=me,this.setTexture2DArray=ve,this.setTexture3D=Te,this.setTextureCube=ge,this.rebindTextures=Kt,this.setupRenderTarget=jt,this.updateRenderTargetMipmap=F,this.updateMultisampleRenderTarget=rt,this.setupDepthRenderbuffer=Jt,this.setupFrameBufferTexture=lt,this.useMultisampledRTT=de,this.dispose=V}function fx(s,e){function t(n,i=Wn){let r,o=Xe.getTransfer(i);if(n===Ht)return s.UNSIGNED_BYTE;if(n===jo)return s.UNSIGNED_SHORT_4_4_4_4;if(n===Qo)return s.UNSIGNED_SHORT_5_5_5_1;if(n===Sc)return s.UNSIGNED_INT_5_9_9_9_REV;if(n===wc)return s.UNSIGNED_INT_10F_11F_11F_REV;if(n===bc)return s.BYTE;if(n===Mc)return s.SHORT;if(n===as)return s.UNSIGNED_SHORT;if(n===Ko)return s.INT;if(n===dn)return s.UNSIGNED_INT;if(n===fn)return s.FLOAT;if(n===pn)return s.HALF_FLOAT;if(n===Ec)return s.ALPHA;if(n===Ac)return s.RGB;if(n===mn)return s.RGBA;if(n===Un)return s.DEPTH_COMPONENT;if(n===Hn)return s.DEPTH_STENCIL;if(n===Tc)return s.RED;if(n===ea)return s.RED_INTEGER;if(n===ci)return s.RG;if(n===ta)return s.RG_INTEGER;if(n===na)return s.RGBA_INTEGER;if(n===Qs||n===er||n===tr||n===nr)if(o===Ze)if(r=e.get("WEBGL_compressed_texture_s3tc_srgb"),r!==null){if(n===Qs)return r.COMPRESSED_SRGB_S3TC_DXT1_EXT;if(n===er)return r.COMPRESSED_SRGB_ALPHA_S3TC_DXT1_EXT;if(n===tr)return r.COMPRESSED_SRGB_ALPHA_S3TC_DXT3_EXT;if(n===nr)return r.COMPRESSED_SRGB_ALPHA_S3TC_DXT5_EXT}else return null;else if(r=e.get("WEBGL_compressed_texture_s3tc"),r!==null){if(n===Qs)return r.COMPRESSED_RGB_S3TC_DXT1_EXT;if(n===er)return r.COMPRESSED_RGBA_S3TC_DXT1_EXT;if(n===tr)return r.COMPRESSED_RGBA_S3TC_DXT3_EXT;if(n===nr)return r.COMPRESSED_RGBA_S3TC_DXT5_EXT}else return null;if(n===ia||n===sa||n===ra||n===oa)if(r=e.get("WEBGL_compressed_texture_pvrtc"),r!==null){if(n===ia)return r.COMPRESSED_RGB_PVRTC_4BPPV1_IMG;if(n===sa)return r.COMPRESSED_RGB_PVRTC_2BPPV1_IMG;if(n===ra)return r.COMPRESSED_RGBA_PVRTC_4BPPV1_IMG;if(n===oa)return r.COMPRESSED_RGBA_PVRTC_2BPPV1_IMG}else return null;if(n===aa||n===la||n===ca||n===ha||n===ua||n===ir||n===da)if(r=e.get("WEBGL_compressed_texture_etc"),r!==null){if(n===aa||n===la)return o===Ze?r.COMPRESSED_SRGB8_ETC2:r.COMPRESSED_RGB8_ETC2;if(n===ca)return o===Ze?r.COMPRESSED_SRGB8_ALPHA8_ETC2_EAC:r.COMPRESSED_RGBA8_ETC2_EAC;if(n===ha)return r.COMPRESSED_R11_EAC;if(n===ua)return r.COMPRESSED_SIGNED_R11_EAC;if(n===ir)return r.COMPRESSED_RG11_EAC;if(n===da)return r.COMPRESSED_SIGNED_RG11_EAC}else return null;if(n===fa||n===pa||n===ma||n===ga||n===ya||n===xa||n===va||n===_a||n===ba||n===Ma||n===Sa||n===wa||n===Ea||n===Aa)if(r=e.get("WEBGL_compressed_texture_astc"),r!==null){if(n===fa)return o===Ze?r.COMPRESSED_SRGB8_ALPHA8_ASTC_4x4_KHR:r.COMPRESSED_RGBA_ASTC_4x4_KHR;if(n===pa)return o===Ze?r.COMPRESSED_SRGB8_ALPHA8_ASTC_5x4_KHR:r.COMPRESSED_RGBA_ASTC_5x4_KHR;if(n===ma)return o===Ze?r.COMPRESSED_SRGB8_ALPHA8_ASTC_5x5_KHR:r.COMPRESSED_RGBA_ASTC_5x5_KHR;if(n===ga)return o===Ze?r.COMPRESSED_SRGB8_ALPHA8_ASTC_6x5_KHR:r.COMPRESSED_RGBA_ASTC_6x5_KHR;if(n===ya)return o===Ze?r.COMPRESSED_SRGB8_ALPHA8_ASTC_6x6_KHR:r.COMPRESSED_RGBA_ASTC_6x6_KHR;if(n===xa)return o===Ze?r.COMPRESSED_SRGB8_ALPHA8_ASTC_8x5_KHR:r.COMPRESSED_RGBA_ASTC_8x5_KHR;if(n===va)return o===Ze?r.COMPRESSED_SRGB8_ALPHA8_ASTC_8x6_KHR:r.COMPRESSED_RGBA_ASTC_8x6_KHR;if(n===_a)return o===Ze?r.COMPRESSED_SRGB8_ALPHA8_ASTC_8x8_KHR:r.COMPRESSED_RGBA_ASTC_8x8_KHR;if(n===ba)return o===Ze?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x5_KHR:r.COMPRESSED_RGBA_ASTC_10x5_KHR;if(n===Ma)return o===Ze?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x6_KHR:r.COMPRESSED_RGBA_ASTC_10x6_KHR;if(n===Sa)return o===Ze?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x8_KHR:r.COMPRESSED_RGBA_ASTC_10x8_KHR;if(n===wa)return o===Ze?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x10_KHR:r.COMPRESSED_RGBA_ASTC_10x10_KHR;if(n===Ea)return o===Ze?r.COMPRESSED_SRGB8_ALPHA8_ASTC_12x10_KHR:r.COMPRESSED_RGBA_ASTC_12x10_KHR;if(n===Aa)return o===Ze?r.COMPRESSED_SRGB8_ALPHA8_ASTC_12x12_KHR:r.COMPRESSED_RGBA_ASTC_12x12_KHR}else return null;if(n===Ta||n===Ra||n===Ca)if(r=e.get("EXT_texture_compression_bptc"),r!==null){if(n===Ta)return o===Ze?r.COMPRESSED_SRGB_ALPHA_BPTC_UNORM_EXT:r.COMPRESSED_RGBA_BPTC_UNORM_EXT;if(n===Ra)return r.COMPRESSED_RGB_BPTC_SIGNED_FLOAT_EXT;if(n===Ca)return r.COMPRESSED_RGB_BPTC_UNSIGNED_FLOAT_EXT}else return null;if(n===Pa||n===Ia||n===sr||n===La)if(r=e.get("EXT_texture_compression_rgtc"),r!==null){if(n===Pa)return r.COMPRESSED_RED_RGTC1_EXT;if(n===Ia)return r.COMPRESSED_SIGNED_RED_RGTC1_EXT;if(n===sr)return r.COMPRESSED_RED_GREEN_RGTC2_EXT;if(n===La)return r.COMPRESSED_SIGNED_RED_GREEN_RGTC2_EXT}else return null;return n===Si?s.UNSIGNED_INT_24_8:s[n]!==void 0?s[n]:null}return{convert:t}}var px=`
void main() {

	gl_Position = vec4( position, 1.0 );

}`,mx=`
uniform sampler2DArray depthColor;
uniform float depthWidth;
uniform float depthHeight;

void main() {

	vec2 coord = vec2( gl_FragCoord.x / depthWidth, gl_FragCoord.y / depthHeight );

	if ( coord.x >= 1.0 ) {

		gl_FragDepth = texture( depthColor, vec3( coord.x - 1.0, coord.y, 1 ) ).r;

	} else {

		gl_FragDepth = texture( depthColor, vec3( coord.x, coord.y, 0 ) ).r;

	}

}`,qc=class{constructor(){this.texture=null,this.mesh=null,this.depthNear=0,this.depthFar=0}init(e,t){if(this.texture===null){let n=new zs(e.texture);(e.depthNear!==t.depthNear||e.depthFar!==t.depthFar)&&(this.depthNear=e.depthNear,this.depthFar=e.depthFar),this.texture=n}}getMesh(e){if(this.texture!==null&&this.mesh===null){let t=e.cameras[0].viewport,n=new Dt({vertexShader:px,fragmentShader:mx,uniforms:{depthColor:{value:this.texture},depthWidth:{value:t.z},depthHeight:{value:t.w}}});this.mesh=new ht(new Vn(20,20),n)}return this.mesh}reset(){this.texture=null,this.mesh=null}getDepthTexture(){return this.texture}},Yc=class extends Mn{constructor(e,t){super();let n=this,i=null,r=1,o=null,a="local-floor",l=1,c=null,h=null,u=null,f=null,d=null,g=null,x=typeof XRWebGLBinding<"u",p=new qc,m={},b=t.getContextAttributes(),T=null,E=null,M=[],w=[],y=new Be,S=null,I=null,R=new Ot;R.viewport=new at;let N=new Ot;N.viewport=new at;let O=[R,N],D=new qo,P=null,V=null;this.cameraAutoUpdate=!0,this.enabled=!1,this.isPresenting=!1,this.getController=function(J){let me=M[J];return me===void 0&&(me=new ji,M[J]=me),me.getTargetRaySpace()},this.getControllerGrip=function(J){let me=M[J];return me===void 0&&(me=new ji,M[J]=me),me.getGripSpace()},this.getHand=function(J){let me=M[J];return me===void 0&&(me=new ji,M[J]=me),me.getHandSpace()};function W(J){let me=w.indexOf(J.inputSource);if(me===-1)return;let ve=M[me];ve!==void 0&&(ve.update(J.inputSource,J.frame,c||o),ve.dispatchEvent({type:J.type,data:J.inputSource}))}function G(){i.removeEventListener("select",W),i.removeEventListener("selectstart",W),i.removeEventListener("selectend",W),i.removeEventListener("squeeze",W),i.removeEventListener("squeezestart",W),i.removeEventListener("squeezeend",W),i.removeEventListener("end",G),i.removeEventListener("inputsourceschange",ee);for(let J=0;J<M.length;J++){let me=w[J];me!==null&&(w[J]=null,M[J].disconnect(me))}P=null,V=null,p.reset();for(let J in m)delete m[J];if(e.setRenderTarget(T),d=null,f=null,u=null,i=null,E=null,Fe.stop(),n.isPresenting=!1,e.setPixelRatio(S),e.setSize(y.width,y.height,!1),I!==null){let J=I.camera;J.fov=I.fov,J.zoom=I.zoom,J.updateProjectionMatrix(),I=null}n.dispatchEvent({type:"sessionend"})}this.setFramebufferScaleFactor=function(J){r=J,n.isPresenting===!0&&Ce("WebXRManager: Cannot change framebuffer scale while presenting.")},this.setReferenceSpaceType=function(J){a=J,n.isPresenting===!0&&Ce("WebXRManager: Cannot change reference space type while presenting.")},this.getReferenceSpace=function(){return c||o},this.setReferenceSpace=function(J){c=J},this.getBaseLayer=function(){return f!==null?f:d},this.getBinding=function(){return u===null&&x&&(u=new XRWebGLBinding(i,t)),u},this.getFrame=function(){return g},this.getSession=function(){return i},this.setSession=async function(J){if(i=J,i!==null){if(T=e.getRenderTarget(),i.addEventListener("select",W),i.addEventListener("selectstart",W),i.addEventListener("selectend",W),i.addEventListener("squeeze",W),i.addEventListener("squeezestart",W),i.addEventListener("squeezeend",W),i.addEventListener("end",G),i.addEventListener("inputsourceschange",ee),b.xrCompatible!==!0&&await t.makeXRCompatible(),S=e.getPixelRatio(),e.getSize(y),x&&"createProjectionLayer"in XRWebGLBinding.prototype){let ve=null,Te=null,ge=null;b.depth&&(ge=b.stencil?t.DEPTH24_STENCIL8:t.DEPTH_COMPONENT24,ve=b.stencil?Hn:Un,Te=b.stencil?Si:dn);let Oe={colorFormat:t.RGBA8,depthFormat:ge,scaleFactor:r};u=this.getBinding(),f=u.createProjectionLayer(Oe),i.updateRenderState({layers:[f]}),e.setPixelRatio(1),e.setSize(f.textureWidth,f.textureHeight,!1),E=new $t(f.textureWidth,f.textureHeight,{format:mn,type:Ht,depthTexture:new zn(f.textureWidth,f.textureHeight,Te,void 0,void 0,void 0,void 0,void 0,void 0,ve),stencilBuffer:b.stencil,colorSpace:e.outputColorSpace,samples:b.antialias?4:0,resolveDepthBuffer:f.ignoreDepthValues===!1,resolveStencilBuffer:f.ignoreDepthValues===!1,storeMultisampledDepthBuffer:f.ignoreDepthValues===!1,storeMultisampledStencilBuffer:f.ignoreDepthValues===!1})}else{let ve={antialias:b.antialias,alpha:!0,depth:b.depth,stencil:b.stencil,framebufferScaleFactor:r};d=new XRWebGLLayer(i,t,ve),i.updateRenderState({baseLayer:d}),e.setPixelRatio(1),e.setSize(d.framebufferWidth,d.framebufferHeight,!1),E=new $t(d.framebufferWidth,d.framebufferHeight,{format:mn,type:Ht,colorSpace:e.outputColorSpace,stencilBuffer:b.stencil,resolveDepthBuffer:d.ignoreDepthValues===!1,resolveStencilBuffer:d.ignoreDepthValues===!1,storeMultisampledDepthBuffer:d.ignoreDepthValues===!1,storeMultisampledStencilBuffer:d.ignoreDepthValues===!1})}E.isXRRenderTarget=!0,this.setFoveation(l),c=null,o=await i.requestReferenceSpace(a),Fe.setContext(i),Fe.start(),n.isPresenting=!0,n.dispatchEvent({type:"sessionstart"})}},this.getEnvironmentBlendMode=function(){if(i!==null)return i.environmentBlendMode},this.getDepthTexture=function(){return p.getDepthTexture()};function ee(J){for(let me=0;me<J.removed.length;me++){let ve=J.removed[me],Te=w.indexOf(ve);Te>=0&&(w[Te]=null,M[Te].disconnect(ve))}for(let me=0;me<J.added.length;me++){let ve=J.added[me],Te=w.indexOf(ve);if(Te===-1){for(let Oe=0;Oe<M.length;Oe++)if(Oe>=w.length){w.push(ve),Te=Oe;break}else if(w[Oe]===null){w[Oe]=ve,Te=Oe;break}if(Te===-1)break}let ge=M[Te];ge&&ge.connect(ve)}}function X(J,me){me===null?J.matrixWorld.copy(J.matrix):J.matrixWorld.multiplyMatrices(me.matrixWorld,J.matrix),J.matrixWorldInverse.copy(J.matrixWorld).invert()}this.updateCamera=function(J){if(i===null)return;let me=J.near,ve=J.far;p.texture!==null&&(p.depthNear>0&&(me=p.depthNear),p.depthFar>0&&(ve=p.depthFar)),D.near=N.near=R.near=me,D.far=N.far=R.far=ve,(P!==D.near||V!==D.far)&&(i.updateRenderState({depthNear:D.near,depthFar:D.far}),P=D.near,V=D.far),D.layers.mask=J.layers.mask|6,R.layers.mask=D.layers.mask&-5,N.layers.mask=D.layers.mask&-3;let Te=J.parent,ge=D.cameras;X(D,Te);for(let Oe=0;Oe<ge.length;Oe++)X(ge[Oe],Te);D.projectionMatrix.copy(R.projectionMatrix),D.projectionMatrixInverse.copy(R.projectionMatrixInverse),I===null&&J.isPerspectiveCamera&&(I={camera:J,fov:J.fov,zoom:J.zoom}),Q(J,D,Te)};function Q(J,me,ve){ve===null?J.matrix.copy(me.matrixWorld):(J.matrix.copy(ve.matrixWorld),J.matrix.invert(),J.matrix.multiply(me.matrixWorld)),J.matrix.decompose(J.position,J.quaternion,J.scale),J.updateMatrixWorld(!0),J.projectionMatrix.copy(me.projectionMatrix),J.projectionMatrixInverse.copy(me.projectionMatrixInverse),J.isPerspectiveCamera&&(J.fov=So*2*Math.atan(1/J.projectionMatrix.elements[5]),J.zoom=1)}this.getCamera=function(){return D},this.getFoveation=function(){if(!(f===null&&d===null))return l},this.setFoveation=function(J){l=J,f!==null&&(f.fixedFoveation=J),d!==null&&d.fixedFoveation!==void 0&&(d.fixedFoveation=J)},this.hasDepthSensing=function(){return p.texture!==null},this.getDepthSensingMesh=function(){return p.getMesh(D)},this.getCameraTexture=function(J){return m[J]};let te=null;function Me(J,me){if(h=me.getViewerPose(c||o),g=me,h!==null){let ve=h.views;d!==null&&(e.setRenderTargetFramebuffer(E,d.framebuffer),e.setRenderTarget(E));let Te=!1;ve.length!==D.cameras.length&&(D.cameras.length=0,Te=!0);for(let Pe=0;Pe<ve.length;Pe++){let Je=ve[Pe],Qe=null;if(d!==null)Qe=d.getViewport(Je);else{let At=u.getViewSubImage(f,Je);Qe=At.viewport,Pe===0&&(e.setRenderTargetTextures(E,At.colorTexture,At.depthStencilTexture),e.setRenderTarget(E))}let Ge=O[Pe];Ge===void 0&&(Ge=new Ot,Ge.layers.enable(Pe),Ge.viewport=new at,O[Pe]=Ge),Ge.matrix.fromArray(Je.transform.matrix),Ge.matrix.decompose(Ge.position,Ge.quaternion,Ge.scale),Ge.projectionMatrix.fromArray(Je.projectionMatrix),Ge.projectionMatrixInverse.copy(Ge.projectionMatrix).invert(),Ge.viewport.set(Qe.x,Qe.y,Qe.width,Qe.height),Pe===0&&(D.matrix.copy(Ge.matrix),D.matrix.decompose(D.position,D.quaternion,D.scale)),Te===!0&&D.cameras.push(Ge)}let ge=i.enabledFeatures;if(ge&&ge.includes("depth-sensing")&&i.depthUsage=="gpu-optimized"&&x){u=n.getBinding();let Pe=u.getDepthInformation(ve[0]);Pe&&Pe.isValid&&Pe.texture&&p.init(Pe,i.renderState)}if(ge&&ge.includes("camera-access")&&x){e.state.unbindTexture(),u=n.getBinding();for(let Pe=0;Pe<ve.length;Pe++){let Je=ve[Pe].camera;if(Je){let Qe=m[Je];Qe||(Qe=new zs,m[Je]=Qe);let Ge=u.getCameraImage(Je);Qe.sourceTexture=Ge}}}}for(let ve=0;ve<M.length;ve++){let Te=w[ve],ge=M[ve];Te!==null&&ge!==void 0&&ge.update(Te,me,c||o)}te&&te(J,me),me.detectedPlanes&&n.dispatchEvent({type:"planesdetected",data:me}),g=null}let Fe=new _d;Fe.setAnimationLoop(Me),this.setAnimationLoop=function(J){te=J},this.dispose=function(){}}},gx=new je,Pd=new Ne;Pd.set(-1,0,0,0,1,0,0,0,1);function yx(s,e){function t(p,m){p.matrixAutoUpdate===!0&&p.updateMatrix(),m.value.copy(p.matrix)}function n(p,m){m.color.getRGB(p.fogColor.value,Dc(s)),m.isFog?(p.fogNear.value=m.near,p.fogFar.value=m.far):m.isFogExp2&&(p.fogDensity.value=m.density)}function i(p,m,b,T,E){m.isNodeMaterial?m.uniformsNeedUpdate=!1:m.isMeshBasicMaterial?r(p,m):m.isMeshLambertMaterial?(r(p,m),m.envMap&&(p.envMapIntensity.value=m.envMapIntensity)):m.isMeshToonMaterial?(r(p,m),u(p,m)):m.isMeshPhongMaterial?(r(p,m),h(p,m),m.envMap&&(p.envMapIntensity.value=m.envMapIntensity)):m.isMeshStandardMaterial?(r(p,m),f(p,m),m.isMeshPhysicalMaterial&&d(p,m,E)):m.isMeshMatcapMaterial?(r(p,m),g(p,m)):m.isMeshDepthMaterial?r(p,m):m.isMeshDistanceMaterial?(r(p,m),x(p,m)):m.isMeshNormalMaterial?r(p,m):m.isLineBasicMaterial?(o(p,m),m.isLineDashedMaterial&&a(p,m)):m.isPointsMaterial?l(p,m,b,T):m.isSpriteMaterial?c(p,m):m.isShadowMaterial?(p.color.value.copy(m.color),p.opacity.value=m.opacity):m.isShaderMaterial&&(m.uniformsNeedUpdate=!1)}function r(p,m){p.opacity.value=m.opacity,m.color&&p.diffuse.value.copy(m.color),m.emissive&&p.emissive.value.copy(m.emissive).multiplyScalar(m.emissiveIntensity),m.map&&(p.map.value=m.map,t(m.map,p.mapTransform)),m.alphaMap&&(p.alphaMap.value=m.alphaMap,t(m.alphaMap,p.alphaMapTransform)),m.bumpMap&&(p.bumpMap.value=m.bumpMap,t(m.bumpMap,p.bumpMapTransform),p.bumpScale.value=m.bumpScale,m.side===Ct&&(p.bumpScale.value*=-1)),m.normalMap&&(p.normalMap.value=m.normalMap,t(m.normalMap,p.normalMapTransform),p.normalScale.value.copy(m.normalScale),m.side===Ct&&p.normalScale.value.negate()),m.displacementMap&&(p.displacementMap.value=m.displacementMap,t(m.displacementMap,p.displacementMapTransform),p.displacementScale.value=m.displacementScale,p.displacementBias.value=m.displacementBias),m.emissiveMap&&(p.emissiveMap.value=m.emissiveMap,t(m.emissiveMap,p.emissiveMapTransform)),m.specularMap&&(p.specularMap.value=m.specularMap,t(m.specularMap,p.specularMapTransform)),m.alphaTest>0&&(p.alphaTest.value=m.alphaTest);let b=e.get(m),T=b.envMap,E=b.envMapRotation;T&&(p.envMap.value=T,p.envMapRotation.value.setFromMatrix4(gx.makeRotationFromEuler(E)).transpose(),T.isCubeTexture&&T.isRenderTargetTexture===!1&&p.envMapRotation.value.premultiply(Pd),p.reflectivity.value=m.reflectivity,p.ior.value=m.ior,p.refractionRatio.value=m.refractionRatio),m.lightMap&&(p.lightMap.value=m.lightMap,p.lightMapIntensity.value=m.lightMapIntensity,t(m.lightMap,p.lightMapTransform)),m.aoMap&&(p.aoMap.value=m.aoMap,p.aoMapIntensity.value=m.aoMapIntensity,t(m.aoMap,p.aoMapTransform))}function o(p,m){p.diffuse.value.copy(m.color),p.opacity.value=m.opacity,m.map&&(p.map.value=m.map,t(m.map,p.mapTransform))}function a(p,m){p.dashSize.value=m.dashSize,p.totalSize.value=m.dashSize+m.gapSize,p.scale.value=m.scale}function l(p,m,b,T){p.diffuse.value.copy(m.color),p.opacity.value=m.opacity,p.size.value=m.size*b,p.scale.value=T*.5,m.map&&(p.map.value=m.map,t(m.map,p.uvTransform)),m.alphaMap&&(p.alphaMap.value=m.alphaMap,t(m.alphaMap,p.alphaMapTransform)),m.alphaTest>0&&(p.alphaTest.value=m.alphaTest)}function c(p,m){p.diffuse.value.copy(m.color),p.opacity.value=m.opacity,p.rotation.value=m.rotation,m.map&&(p.map.value=m.map,t(m.map,p.mapTransform)),m.alphaMap&&(p.alphaMap.value=m.alphaMap,t(m.alphaMap,p.alphaMapTransform)),m.alphaTest>0&&(p.alphaTest.value=m.alphaTest)}function h(p,m){p.specular.value.copy(m.specular),p.shininess.value=Math.max(m.shininess,1e-4)}function u(p,m){m.gradientMap&&(p.gradientMap.value=m.gradientMap)}function f(p,m){p.metalness.value=m.metalness,m.metalnessMap&&(p.metalnessMap.value=m.metalnessMap,t(m.metalnessMap,p.metalnessMapTransform)),p.roughness.value=m.roughness,m.roughnessMap&&(p.roughnessMap.value=m.roughnessMap,t(m.roughnessMap,p.roughnessMapTransform)),m.envMap&&(p.envMapIntensity.value=m.envMapIntensity)}function d(p,m,b){p.ior.value=m.ior,m.diffuseRoughness>0&&(p.diffuseRoughness.value=m.diffuseRoughness,m.diffuseRoughnessMap&&(p.diffuseRoughnessMap.value=m.diffuseRoughnessMap,t(m.diffuseRoughnessMap,p.diffuseRoughnessMapTransform))),m.sheen>0&&(p.sheenColor.value.copy(m.sheenColor).multiplyScalar(m.sheen),p.sheenRoughness.value=m.sheenRoughness,m.sheenColorMap&&(p.sheenColorMap.value=m.sheenColorMap,t(m.sheenColorMap,p.sheenColorMapTransform)),m.sheenRoughnessMap&&(p.sheenRoughnessMap.value=m.sheenRoughnessMap,t(m.sheenRoughnessMap,p.sheenRoughnessMapTransform))),m.clearcoat>0&&(p.clearcoat.value=m.clearcoat,p.clearcoatRoughness.value=m.clearcoatRoughness,m.clearcoatMap&&(p.clearcoatMap.value=m.clearcoatMap,t(m.clearcoatMap,p.clearcoatMapTransform)),m.clearcoatRoughnessMap&&(p.clearcoatRoughnessMap.value=m.clearcoatRoughnessMap,t(m.clearcoatRoughnessMap,p.clearcoatRoughnessMapTransform)),m.clearcoatNormalMap&&(p.clearcoatNormalMap.value=m.clearcoatNormalMap,t(m.clearcoatNormalMap,p.clearcoatNormalMapTransform),p.clearcoatNormalScale.value.copy(m.clearcoatNormalScale),m.side===Ct&&p.clearcoatNormalScale.value.negate())),m.dispersion>0&&(p.dispersion.value=m.dispersion),m.retroreflectivity>0&&(p.retroreflectivity.value=m.retroreflectivity),m.iridescence>0&&(p.iridescence.value=m.iridescence,p.iridescenceIOR.value=m.iridescenceIOR,p.iridescenceThicknessMinimum.value=m.iridescenceThicknessMinimum,p.iridescenceThicknessMaximum.value=m.iridescenceThicknessMaximum,m.iridescenceMap&&(p.iridescenceMap.value=m.iridescenceMap,t(m.iridescenceMap,p.iridescenceMapTransform)),m.iridescenceThicknessMap&&(p.iridescenceThicknessMap.value=m.iridescenceThicknessMap,t(m.iridescenceThicknessMap,p.iridescenceThicknessMapTransform))),m.transmission>0&&(p.transmission.value=m.transmission,p.transmissionSamplerMap.value=b.texture,p.transmissionSamplerSize.value.set(b.width,b.height),m.transmissionMap&&(p.transmissionMap.value=m.transmissionMap,t(m.transmissionMap,p.transmissionMapTransform)),p.thickness.value=m.thickness,m.thicknessMap&&(p.thicknessMap.value=m.thicknessMap,t(m.thicknessMap,p.thicknessMapTransform)),p.attenuationDistance.value=m.attenuationDistance,p.attenuationColor.value.copy(m.attenuationColor)),m.anisotropy>0&&(p.anisotropyVector.value.set(m.anisotropy*Math.cos(m.anisotropyRotation),m.anisotropy*Math.sin(m.anisotropyRotation)),m.anisotropyMap&&(p.anisotropyMap.value=m.anisotropyMap,t(m.anisotropyMap,p.anisotropyMapTransform))),p.specularIntensity.value=m.specularIntensity,p.specularColor.value.copy(m.specularColor),m.specularColorMap&&(p.specularColorMap.value=m.specularColorMap,t(m.specularColorMap,p.specularColorMapTransform)),m.specularIntensityMap&&(p.specularIntensityMap.value=m.specularIntensityMap,t(m.specularIntensityMap,p.specularIntensityMapTransform))}function g(p,m){m.matcap&&(p.matcap.value=m.matcap)}function x(p,m){let b=e.get(m).light;p.referencePosition.value.setFromMatrixPosition(b.matrixWorld),p.nearDistance.value=b.shadow.camera.near,p.farDistance.value=b.shadow.camera.far}return{refreshFogUniforms:n,refreshMaterialUniforms:i}}function xx(s,e,t,n){let i={},r={};function o(b,T){let E=T.program;n.uniformBlockBinding(b,E,i[b.id])}function a(b,T){let E=i[b.id];E===void 0&&(g(b),E=l(b),i[b.id]=E,b.addEventListener("dispose",p));let M=T.program;n.updateUBOMapping(b,M);let w=e.render.frame;r[b.id]!==w&&(c(b),r[b.id]=w)}function l(b){let T=s.createBuffer(),E=b.__size,M=b.usage;return s.bindBuffer(s.UNIFORM_BUFFER,T),s.bufferData(s.UNIFORM_BUFFER,E,M),s.bindBuffer(s.UNIFORM_BUFFER,null),T}function c(b){let T=i[b.id],E=b.uniforms,M=b.__cache;s.bindBuffer(s.UNIFORM_BUFFER,T);for(let w=0,y=E.length;w<y;w++){let S=E[w];if(Array.isArray(S))for(let I=0,R=S.length;I<R;I++)h(S[I],w,I,M);else h(S,w,0,M)}s.bindBuffer(s.UNIFORM_BUFFER,null)}function h(b,T,E,M){if(f(b,T,E,M)===!0){let w=b.__offset,y=b.value;if(Array.isArray(y)){let S=0;for(let I=0;I<y.length;I++){let R=y[I],N=x(R,!0);u(R,b.__data,S),S+=N.storage/Float32Array.BYTES_PER_ELEMENT}}else u(y,b.__data,0);s.bufferSubData(s.UNIFORM_BUFFER,w,b.__data)}}function u(b,T,E){typeof b=="number"||typeof b=="boolean"?T[E]=b:b.isMatrix3?(T[E]=b.elements[0],T[E+1]=b.elements[1],T[E+2]=b.elements[2],T[E+3]=0,T[E+4]=b.elements[3],T[E+5]=b.elements[4],T[E+6]=b.elements[5],T[E+7]=0,T[E+8]=b.elements[6],T[E+9]=b.elements[7],T[E+10]=b.elements[8],T[E+11]=0):ArrayBuffer.isView(b)?T.set(b.subarray(0,T.length-E),E):b.toArray(T,E)}function f(b,T,E,M){let w=b.value,y=T+"_"+E;if(Array.isArray(w)){M[y]===void 0&&(M[y]=[]);let S=M[y],I=!1;for(let R=0;R<w.length;R++)d(w[R],S,R)===!0&&(I=!0);return I}return d(w,M,y)}function d(b,T,E){if(T[E]===void 0)return typeof b=="number"||typeof b=="boolean"?T[E]=b:ArrayBuffer.isView(b)?T[E]=b.slice():T[E]=b.clone(),!0;{let M=T[E];if(typeof b=="number"||typeof b=="boolean"){if(M!==b)return T[E]=b,!0}else{if(ArrayBuffer.isView(b))return!0;if(M.equals(b)===!1)return M.copy(b),!0}}return!1}function g(b){let T=b.uniforms,E=0,M=16;for(let y=0,S=T.length;y<S;y++){let I=Array.isArray(T[y])?T[y]:[T[y]];for(let R=0,N=I.length;R<N;R++){let O=I[R],D=Array.isArray(O.value)?O.value:[O.value],P=Array.isArray(T[y])||Array.isArray(O.value),V=E;for(let G=0,ee=D.length;G<ee;G++){let X=D[G],Q=x(X,P),te=E%M,Me=te%Q.boundary,Fe=te+Me;E+=Me,Fe!==0&&M-Fe<Q.storage&&(E+=M-Fe),G===0&&(V=E),E+=Q.storage}let W=O.type==="int"?Int32Array:O.type==="uint"?Uint32Array:Float32Array;O.__data=new W((E-V)/Float32Array.BYTES_PER_ELEMENT),O.__offset=V}}let w=E%M;return w>0&&(E+=M-w),b.__size=E,b.__cache={},this}function x(b,T){let E={boundary:0,storage:0};return typeof b=="number"||typeof b=="boolean"?(E.boundary=4,E.storage=4):b.isVector2?(E.boundary=8,E.storage=8):b.isVector3||b.isColor?(E.boundary=16,E.storage=12):b.isVector4?(E.boundary=16,E.storage=16):b.isMatrix3?(E.boundary=16,E.storage=48):b.isMatrix4?(E.boundary=16,E.storage=64):b.isTexture?Ce("WebGLRenderer: Texture samplers can not be part of an uniforms group."):ArrayBuffer.isView(b)?(E.boundary=16,E.storage=b.byteLength):Ce("WebGLRenderer: Unsupported uniform value type.",b),T===!0&&(E.boundary=16,E.storage=Math.ceil(E.storage/16)*16),E}function p(b){let T=b.target;T.removeEventListener("dispose",p),s.deleteBuffer(i[T.id]),delete i[T.id],delete r[T.id]}function m(){for(let b in i)s.deleteBuffer(i[b]);i={},r={}}return{bind:o,update:a,dispose:m}}var vx=new Uint16Array([12469,15057,12620,14925,13266,14620,13807,14376,14323,13990,14545,13625,14713,13328,14840,12882,14931,12528,14996,12233,15039,11829,15066,11525,15080,11295,15085,10976,15082,10705,15073,10495,13880,14564,13898,14542,13977,14430,14158,14124,14393,13732,14556,13410,14702,12996,14814,12596,14891,12291,14937,11834,14957,11489,14958,11194,14943,10803,14921,10506,14893,10278,14858,9960,14484,14039,14487,14025,14499,13941,14524,13740,14574,13468,14654,13106,14743,12678,14818,12344,14867,11893,14889,11509,14893,11180,14881,10751,14852,10428,14812,10128,14765,9754,14712,9466,14764,13480,14764,13475,14766,13440,14766,13347,14769,13070,14786,12713,14816,12387,14844,11957,14860,11549,14868,11215,14855,10751,14825,10403,14782,10044,14729,9651,14666,9352,14599,9029,14967,12835,14966,12831,14963,12804,14954,12723,14936,12564,14917,12347,14900,11958,14886,11569,14878,11247,14859,10765,14828,10401,14784,10011,14727,9600,14660,9289,14586,8893,14508,8533,15111,12234,15110,12234,15104,12216,15092,12156,15067,12010,15028,11776,14981,11500,14942,11205,14902,10752,14861,10393,14812,9991,14752,9570,14682,9252,14603,8808,14519,8445,14431,8145,15209,11449,15208,11451,15202,11451,15190,11438,15163,11384,15117,11274,15055,10979,14994,10648,14932,10343,14871,9936,14803,9532,14729,9218,14645,8742,14556,8381,14461,8020,14365,7603,15273,10603,15272,10607,15267,10619,15256,10631,15231,10614,15182,10535,15118,10389,15042,10167,14963,9787,14883,9447,14800,9115,14710,8665,14615,8318,14514,7911,14411,7507,14279,7198,15314,9675,15313,9683,15309,9712,15298,9759,15277,9797,15229,9773,15166,9668,15084,9487,14995,9274,14898,8910,14800,8539,14697,8234,14590,7790,14479,7409,14367,7067,14178,6621,15337,8619,15337,8631,15333,8677,15325,8769,15305,8871,15264,8940,15202,8909,15119,8775,15022,8565,14916,8328,14804,8009,14688,7614,14569,7287,14448,6888,14321,6483,14088,6171,15350,7402,15350,7419,15347,7480,15340,7613,15322,7804,15287,7973,15229,8057,15148,8012,15046,7846,14933,7611,14810,7357,14682,7069,14552,6656,14421,6316,14251,5948,14007,5528,15356,5942,15356,5977,15353,6119,15348,6294,15332,6551,15302,6824,15249,7044,15171,7122,15070,7050,14949,6861,14818,6611,14679,6349,14538,6067,14398,5651,14189,5311,13935,4958,15359,4123,15359,4153,15356,4296,15353,4646,15338,5160,15311,5508,15263,5829,15188,6042,15088,6094,14966,6001,14826,5796,14678,5543,14527,5287,14377,4985,14133,4586,13869,4257,15360,1563,15360,1642,15358,2076,15354,2636,15341,3350,15317,4019,15273,4429,15203,4732,15105,4911,14981,4932,14836,4818,14679,4621,14517,4386,14359,4156,14083,3795,13808,3437,15360,122,15360,137,15358,285,15355,636,15344,1274,15322,2177,15281,2765,15215,3223,15120,3451,14995,3569,14846,3567,14681,3466,14511,3305,14344,3121,14037,2800,13753,2467,15360,0,15360,1,15359,21,15355,89,15346,253,15325,479,15287,796,15225,1148,15133,1492,15008,1749,14856,1882,14685,1886,14506,1783,14324,1608,13996,1398,13702,1183]),En=null;function _x(){return En===null&&(En=new To(vx,16,16,ci,pn),En.name="DFG_LUT",En.minFilter=kt,En.magFilter=kt,En.wrapS=bn,En.wrapT=bn,En.generateMipmaps=!1,En.needsUpdate=!0),En}var Oa=class{constructor(e={}){let{canvas:t=Wu(),context:n=null,depth:i=!0,stencil:r=!1,alpha:o=!1,antialias:a=!1,premultipliedAlpha:l=!0,preserveDrawingBuffer:c=!1,powerPreference:h="default",failIfMajorPerformanceCaveat:u=!1,reversedDepthBuffer:f=!1,outputBufferType:d=Ht}=e;this.isWebGLRenderer=!0;let g;if(n!==null){if(typeof WebGLRenderingContext<"u"&&n instanceof WebGLRenderingContext)throw new Error("THREE.WebGLRenderer: WebGL 1 is not supported since r163.");g=n.getContextAttributes().alpha}else g=o;let x=d,p=new Set([na,ta,ea]),m=new Set([Ht,dn,as,Si,jo,Qo]),b=new Uint32Array(4),T=new Int32Array(4),E={textures:[],min:[],max:[],resolution:[]},M=null,w=null,y=[],S=[],I=null;this.domElement=t,this.debug={checkShaderErrors:!0,diagnostics:{keywords:!1},onShaderError:null},this.autoClear=!0,this.autoClearColor=!0,this.autoClearDepth=!0,this.autoClearStencil=!0,this.sortObjects=!0,this.clippingPlanes=[],this.localClippingEnabled=!1,this.toneMapping=wn,this.toneMappingExposure=1,this.transmissionResolutionScale=1;let R=this,N=!1,O=null,D=null,P=null,V=null;this._outputColorSpace=Yt;let W=0,G=0,ee=null,X=-1,Q=null,te=new at,Me=new at,Fe=null,J=new Ie(0),me=0,ve=t.width,Te=t.height,ge=1,Oe=null,dt=null,Pe=new at(0,0,ve,Te),Je=new at(0,0,ve,Te),Qe=!1,Ge=new ni,At=new Ro,mt=!1,zt=!1,lt=new je,yn=new U,vt=new at,Jt={background:null,fog:null,environment:null,overrideMaterial:null,isScene:!0},Kt=!1;function jt(){return ee===null?ge:1}let F=n;function Qt(_,L){return t.getContext(_,L)}let rt,ot,de,gt,Re,De,A,v,k,ne,j,re,he,Y,$,ae,C,K,q,le,se,oe,we;try{let _={alpha:!0,depth:i,stencil:r,antialias:a,premultipliedAlpha:l,preserveDrawingBuffer:c,powerPreference:h,failIfMajorPerformanceCaveat:u};if("setAttribute"in t&&t.setAttribute("data-engine",`three.js r${"187"}`),t.addEventListener("webglcontextlost",Ee,!1),t.addEventListener("webglcontextrestored",ke,!1),t.addEventListener("webglcontextcreationerror",fe,!1),F===null){let L="webgl2";if(F=Qt(L,_),F===null)throw Qt(L)?new Error("THREE.WebGLRenderer: Error creating WebGL context with your selected attributes."):new Error("THREE.WebGLRenderer: Error creating WebGL context.")}ze()}catch(_){throw t.removeEventListener("webglcontextlost",Ee,!1),t.removeEventListener("webglcontextrestored",ke,!1),t.removeEventListener("webglcontextcreationerror",fe,!1),Le("WebGLRenderer: "+_.message),_}function ze(){rt=new I0(F),rt.init(),se=new fx(F,rt),ot=new _0(F,rt,e,se),de=new ux(F,rt),ot.reversedDepthBuffer&&f&&de.buffers.depth.setReversed(!0),D=F.createFramebuffer(),P=F.createFramebuffer(),V=F.createFramebuffer(),gt=new D0(F),Re=new Ky,De=new dx(F,rt,de,Re,ot,se,gt),A=new P0(R),v=new Up(F),oe=new x0(F,v),k=new L0(F,v,gt,oe),ne=new U0(F,k,v,oe,gt),K=new F0(F,ot,De),$=new b0(Re),j=new Jy(R,A,rt,ot,oe,$),re=new yx(R,Re),he=new Qy,Y=new rx(rt),C=new y0(R,A,de,ne,g,l),ae=new hx(R,ne,ot),we=new xx(F,gt,ot,de),q=new v0(F,rt,gt),le=new N0(F,rt,gt),gt.programs=j.programs,R.capabilities=ot,R.extensions=rt,R.properties=Re,R.renderLists=he,R.shadowMap=ae,R.state=de,R.info=gt}x!==Ht&&(I=new B0(x,t.width,t.height,a,i,r));let ie=new Yc(R,F);this.xr=ie,this.getContext=function(){return F},this.getContextAttributes=function(){return F.getContextAttributes()},this.forceContextLoss=function(){let _=rt.get("WEBGL_lose_context");_&&_.loseContext()},this.forceContextRestore=function(){let _=rt.get("WEBGL_lose_context");_&&_.restoreContext()},this.getPixelRatio=function(){return ge},this.setPixelRatio=function(_){_!==void 0&&(ge=_,this.setSize(ve,Te,!1))},this.getSize=function(_){return _.set(ve,Te)},this.setSize=function(_,L,H=!0){if(ie.isPresenting){Ce("WebGLRenderer: Can't change size while VR device is presenting.");return}ve=_,Te=L,t.width=Math.floor(_*ge),t.height=Math.floor(L*ge),H===!0&&(t.style.width=_+"px",t.style.height=L+"px"),I!==null&&I.setSize(t.width,t.height),this.setViewport(0,0,_,L)},this.getDrawingBufferSize=function(_){return _.set(ve*ge,Te*ge).floor()},this.setDrawingBufferSize=function(_,L,H){ve=_,Te=L,ge=H,t.width=Math.floor(_*H),t.height=Math.floor(L*H),this.setViewport(0,0,_,L)},this.setEffects=function(_){if(x===Ht){Le("WebGLRenderer: setEffects() requires outputBufferType set to HalfFloatType or FloatType.");return}if(_){for(let L=0;L<_.length;L++)if(_[L].isOutputPass===!0){Ce("WebGLRenderer: OutputPass is not needed in setEffects(). Tone mapping and color space conversion are applied automatically.");break}}I.setEffects(_||[])},this.getCurrentViewport=function(_){return _.copy(te)},this.getViewport=function(_){return _.copy(Pe)},this.setViewport=function(_,L,H,B){_.isVector4?Pe.set(_.x,_.y,_.z,_.w):Pe.set(_,L,H,B),de.viewport(te.copy(Pe).multiplyScalar(jt()).round())},this.getScissor=function(_){return _.copy(Je)},this.setScissor=function(_,L,H,B){_.isVector4?Je.set(_.x,_.y,_.z,_.w):Je.set(_,L,H,B),de.scissor(Me.copy(Je).multiplyScalar(jt()).round())},this.getScissorTest=function(){return Qe},this.setScissorTest=function(_){de.setScissorTest(Qe=_)},this.setOpaqueSort=function(_){Oe=_},this.setTransparentSort=function(_){dt=_},this.getClearColor=function(_){return _.copy(C.getClearColor())},this.setClearColor=function(){C.setClearColor(...arguments)},this.getClearAlpha=function(){return C.getClearAlpha()},this.setClearAlpha=function(){C.setClearAlpha(...arguments)},this.clear=function(_=!0,L=!0,H=!0){let B=0;if(_){let z=!1;if(ee!==null){let ue=ee.texture.format;z=p.has(ue)}if(z){let ue=ee.texture.type,xe=m.has(ue),ce=C.getClearColor(),ye=C.getClearAlpha(),Se=ce.r,Ue=ce.g,He=ce.b;xe?(b[0]=Se,b[1]=Ue,b[2]=He,b[3]=ye,F.clearBufferuiv(F.COLOR,0,b)):(T[0]=Se,T[1]=Ue,T[2]=He,T[3]=ye,F.clearBufferiv(F.COLOR,0,T))}else B|=F.COLOR_BUFFER_BIT}L&&(B|=F.DEPTH_BUFFER_BIT,this.state.buffers.depth.setMask(!0)),H&&(B|=F.STENCIL_BUFFER_BIT,this.state.buffers.stencil.setMask(4294967295)),B!==0&&F.clear(B)},this.clearColor=function(){this.clear(!0,!1,!1)},this.clearDepth=function(){this.clear(!1,!0,!1)},this.clearStencil=function(){this.clear(!1,!1,!0)},this.setNodesHandler=function(_){_.setRenderer(this),O=_},this.dispose=function(){t.removeEventListener("webglcontextlost",Ee,!1),t.removeEventListener("webglcontextrestored",ke,!1),t.removeEventListener("webglcontextcreationerror",fe,!1),C.dispose(),he.dispose(),Y.dispose(),De.dispose(),Re.dispose(),A.dispose(),ne.dispose(),k.dispose(),oe.dispose(),we.dispose(),j.dispose(),ie.dispose(),ie.removeEventListener("sessionstart",ah),ie.removeEventListener("sessionend",lh),hi.stop()};function Ee(_){_.preventDefault(),Lc("WebGLRenderer: Context Lost."),N=!0}function ke(){Lc("WebGLRenderer: Context Restored."),N=!1;let _=gt.autoReset,L=ae.enabled,H=ae.autoUpdate,B=ae.needsUpdate,z=ae.type;ze(),gt.autoReset=_,ae.enabled=L,ae.autoUpdate=H,ae.needsUpdate=B,ae.type=z}function fe(_){Le("WebGLRenderer: A WebGL context could not be created. Reason: ",_.statusMessage)}function Ke(_){let L=_.target;L.removeEventListener("dispose",Ke),_t(L)}function _t(_){Xn(_),Re.remove(_)}function Xn(_){let L=Re.get(_).programs;L!==void 0&&(L.forEach(function(H){j.releaseProgram(H)}),_.isShaderMaterial&&j.releaseShaderCache(_))}this.renderBufferDirect=function(_,L,H,B,z,ue){L===null&&(L=Jt);let xe=z.isMesh&&z.matrixWorld.determinantAffine()<0,ce=_f(_,L,H,B,z);de.setMaterial(B,xe);let ye=H.index,Se=1;if(B.wireframe===!0){if(ye=k.getWireframeAttribute(H),ye===void 0)return;Se=2}let Ue=H.drawRange,He=H.attributes.position,_e=Ue.start*Se,We=(Ue.start+Ue.count)*Se;ue!==null&&(_e=Math.max(_e,ue.start*Se),We=Math.min(We,(ue.start+ue.count)*Se)),ye!==null?(_e=Math.max(_e,0),We=Math.min(We,ye.count)):He!=null&&(_e=Math.max(_e,0),We=Math.min(We,He.count));let ft=We-_e;if(ft<0||ft===1/0)return;oe.setup(z,B,ce,H,ye);let tt,et=q;if(ye!==null&&(tt=v.get(ye),et=le,et.setIndex(tt)),z.isMesh)B.wireframe===!0?(de.setLineWidth(B.wireframeLinewidth*jt()),et.setMode(F.LINES)):et.setMode(F.TRIANGLES);else if(z.isLine){let Pt=B.linewidth;Pt===void 0&&(Pt=1),de.setLineWidth(Pt*jt()),z.isLineSegments?et.setMode(F.LINES):z.isLineLoop?et.setMode(F.LINE_LOOP):et.setMode(F.LINE_STRIP)}else z.isPoints?et.setMode(F.POINTS):z.isSprite&&et.setMode(F.TRIANGLES);if(z.isBatchedMesh)if(rt.get("WEBGL_multi_draw"))et.renderMultiDraw(z._multiDrawStarts,z._multiDrawCounts,z._multiDrawCount);else{let Pt=z._multiDrawStarts,be=z._multiDrawCounts,Ut=z._multiDrawCount,$e=ye?v.get(ye).bytesPerElement:1,ui=Re.get(B).currentProgram.getUniforms();for(let It=0;It<Ut;It++)ui.setValue(F,"_gl_DrawID",It),et.render(Pt[It]/$e,be[It])}else if(z.isInstancedMesh)et.renderInstances(_e,ft,z.count);else if(H.isInstancedBufferGeometry){let Pt=H._maxInstanceCount!==void 0?H._maxInstanceCount:1/0,be=Math.min(H.instanceCount,Pt);et.renderInstances(_e,ft,be)}else et.render(_e,ft)};function oh(_,L,H,B){O!==null&&_.isNodeMaterial&&O.setObject(B,_),mt===!0&&$.setState(_,H,!1),_.transparent===!0&&_.side===Gt&&_.forceSinglePass===!1?(_.side=Ct,_.needsUpdate=!0,ps(_,L,B),_.side=li,_.needsUpdate=!0,ps(_,L,B),_.side=Gt):ps(_,L,B)}this.compile=function(_,L,H=null){H===null&&(H=_),O!==null&&O.renderStart(_,L,H),w=Y.get(H),w.init(L),S.push(w),H.traverseVisible(function(z){z.isLight&&z.layers.test(L.layers)&&(w.pushLight(z),z.castShadow&&w.pushShadow(z))}),_!==H&&_.traverseVisible(function(z){z.isLight&&z.layers.test(L.layers)&&(w.pushLight(z),z.castShadow&&w.pushShadow(z))}),w.setupLights(),O!==null&&O.updateLights(w.state.lightsArray),zt=this.localClippingEnabled,mt=$.init(this.clippingPlanes,zt),mt===!0&&$.setGlobalState(this.clippingPlanes,L),O!==null&&ae.render(w.state.shadowsArray,H,L);let B=new Set;return _.traverse(function(z){if(!(z.isMesh||z.isPoints||z.isLine||z.isSprite))return;let ue=z.material;if(ue)if(Array.isArray(ue))for(let xe=0;xe<ue.length;xe++){let ce=ue[xe];oh(ce,H,L,z),B.add(ce)}else oh(ue,H,L,z),B.add(ue)}),w=S.pop(),O!==null&&O.renderEnd(),B},this.compileAsync=function(_,L,H=null){let B=this.compile(_,L,H);return new Promise(z=>{function ue(){if(B.forEach(function(xe){let ye=Re.get(xe).currentProgram;(ye===void 0||ye.isReady())&&B.delete(xe)}),B.size===0){z(_);return}setTimeout(ue,10)}rt.get("KHR_parallel_shader_compile")!==null?ue():setTimeout(ue,10)})};let yl=null;function xf(_){yl&&yl(_)}function ah(){hi.stop()}function lh(){hi.start()}let hi=new _d;hi.setAnimationLoop(xf),typeof self<"u"&&hi.setContext(self),this.setAnimationLoop=function(_){yl=_,ie.setAnimationLoop(_),_===null?hi.stop():hi.start()},ie.addEventListener("sessionstart",ah),ie.addEventListener("sessionend",lh),this.render=function(_,L){if(L!==void 0&&L.isCamera!==!0){Le("WebGLRenderer.render: camera is not an instance of THREE.Camera.");return}if(N===!0)return;O!==null&&O.renderStart(_,L);let H=ie.enabled===!0&&ie.isPresenting===!0,B=I!==null&&(ee===null||H)&&I.begin(R,ee);if(_.matrixWorldAutoUpdate===!0&&_.updateMatrixWorld(),L.parent===null&&L.matrixWorldAutoUpdate===!0&&L.updateMatrixWorld(),ie.enabled===!0&&ie.isPresenting===!0&&(I===null||I.isCompositing()===!1)&&(ie.cameraAutoUpdate===!0&&ie.updateCamera(L),L=ie.getCamera()),_.isScene===!0&&_.onBeforeRender(R,_,L,ee),w=Y.get(_,S.length),w.init(L),w.state.textureUnits=De.getTextureUnits(),S.push(w),lt.multiplyMatrices(L.projectionMatrix,L.matrixWorldInverse),L.isArrayCamera?At.setFromArrayCamera(L):Ge.setFromProjectionMatrix(lt,tn,L.reversedDepth),zt=this.localClippingEnabled,mt=$.init(this.clippingPlanes,zt),M=he.get(_,y.length),M.init(),y.push(M),this.info.render.frame++,ie.enabled===!0&&ie.isPresenting===!0){let xe=R.xr.getDepthSensingMesh();xe!==null&&xl(xe,L,-1/0,R.sortObjects)}xl(_,L,0,R.sortObjects),M.finish(),O!==null&&O.updateLights(w.state.lightsArray),R.sortObjects===!0&&M.sort(Oe,dt),Kt=ie.enabled===!1||ie.isPresenting===!1||ie.hasDepthSensing()===!1,Kt&&C.addToRenderList(M,_),this.info.autoReset===!0&&this.info.reset(),mt===!0&&$.beginShadows();let z=w.state.shadowsArray;if(ae.render(z,_,L),mt===!0&&$.endShadows(),(B&&I.hasRenderPass())===!1){let xe=M.opaque,ce=M.transmissive;if(w.setupLights(),L.isArrayCamera){let ye=L.cameras;if(ce.length>0)for(let Se=0,Ue=ye.length;Se<Ue;Se++){let He=ye[Se];hh(xe,ce,_,He)}Kt&&C.render(_);for(let Se=0,Ue=ye.length;Se<Ue;Se++){let He=ye[Se];ch(M,_,He,He.viewport)}}else ce.length>0&&hh(xe,ce,_,L),Kt&&C.render(_),ch(M,_,L)}ee!==null&&G===0&&(De.updateMultisampleRenderTarget(ee),De.updateRenderTargetMipmap(ee)),B&&I.end(R),_.isScene===!0&&_.onAfterRender(R,_,L),oe.resetDefaultState(),X=-1,Q=null,S.pop(),S.length>0?(w=S[S.length-1],De.setTextureUnits(w.state.textureUnits),mt===!0&&$.setGlobalState(R.clippingPlanes,w.state.camera)):w=null,y.pop(),y.length>0?M=y[y.length-1]:M=null,O!==null&&O.renderEnd()};function xl(_,L,H,B){if(_.visible===!1)return;if(_.layers.test(L.layers)){if(_.isGroup)H=_.renderOrder;else if(_.isLOD)_.autoUpdate===!0&&_.update(L);else if(_.isLight)w.pushLight(_),_.castShadow&&w.pushShadow(_);else if(_.isSprite){let xe=L.isArrayCamera?At:Ge;if(!_.frustumCulled||_.intersectsFrustum(xe)){B&&vt.setFromMatrixPosition(_.matrixWorld).applyMatrix4(lt);let ce=ne.update(_),ye=_.material;ye.visible&&M.push(_,ce,ye,H,vt.z,null,L)}}else if(_.isMesh||_.isLine||_.isPoints){let xe=L.isArrayCamera?At:Ge;if(!_.frustumCulled||_.intersectsFrustum(xe)){let ce=ne.update(_),ye=_.material;if(B&&(_.boundingSphere!==void 0?(_.boundingSphere===null&&_.computeBoundingSphere(),vt.copy(_.boundingSphere.center)):(ce.boundingSphere===null&&ce.computeBoundingSphere(),vt.copy(ce.boundingSphere.center)),vt.applyMatrix4(_.matrixWorld).applyMatrix4(lt)),Array.isArray(ye)){let Se=ce.groups;for(let Ue=0,He=Se.length;Ue<He;Ue++){let _e=Se[Ue],We=ye[_e.materialIndex];We&&We.visible&&M.push(_,ce,We,H,vt.z,_e,L)}}else ye.visible&&M.push(_,ce,ye,H,vt.z,null,L)}}}let ue=_.children;for(let xe=0,ce=ue.length;xe<ce;xe++)xl(ue[xe],L,H,B)}function ch(_,L,H,B){let{opaque:z,transmissive:ue,transparent:xe}=_;w.setupLightsView(H),mt===!0&&$.setGlobalState(R.clippingPlanes,H),B&&de.viewport(te.copy(B)),z.length>0&&yr(z,L,H),ue.length>0&&yr(ue,L,H),xe.length>0&&yr(xe,L,H),de.buffers.depth.setTest(!0),de.buffers.depth.setMask(!0),de.buffers.color.setMask(!0),de.setPolygonOffset(!1)}function hh(_,L,H,B){if((H.isScene===!0?H.overrideMaterial:null)!==null)return;if(w.state.transmissionRenderTarget[B.id]===void 0){let _e=rt.has("EXT_color_buffer_half_float")||rt.has("EXT_color_buffer_float");w.state.transmissionRenderTarget[B.id]=new $t(1,1,{generateMipmaps:!0,type:_e?pn:Ht,minFilter:Gn,samples:Math.max(4,ot.samples),stencilBuffer:r,resolveDepthBuffer:!1,resolveStencilBuffer:!1,storeMultisampledDepthBuffer:!1,storeMultisampledStencilBuffer:!1,colorSpace:Xe.workingColorSpace})}let ue=w.state.transmissionRenderTarget[B.id],xe=B.viewport||te;ue.setSize(xe.z*R.transmissionResolutionScale,xe.w*R.transmissionResolutionScale);let ce=R.getRenderTarget(),ye=R.getActiveCubeFace(),Se=R.getActiveMipmapLevel();R.setRenderTarget(ue),R.getClearColor(J),me=R.getClearAlpha(),me<1&&R.setClearColor(16777215,.5),R.clear(),Kt&&C.render(H);let Ue=R.toneMapping;R.toneMapping=wn;let He=B.viewport;if(B.viewport!==void 0&&(B.viewport=void 0),w.setupLightsView(B),mt===!0&&$.setGlobalState(R.clippingPlanes,B),yr(_,H,B),De.updateMultisampleRenderTarget(ue),De.updateRenderTargetMipmap(ue),rt.has("WEBGL_multisampled_render_to_texture")===!1){let _e=!1;for(let We=0,ft=L.length;We<ft;We++){let tt=L[We],{object:et,geometry:Pt,material:be,group:Ut}=tt;if(be.side===Gt&&et.layers.test(B.layers)){let $e=be.side;be.side=Ct,be.needsUpdate=!0,uh(et,H,B,Pt,be,Ut),be.side=$e,be.needsUpdate=!0,_e=!0}}_e===!0&&(De.updateMultisampleRenderTarget(ue),De.updateRenderTargetMipmap(ue))}R.setRenderTarget(ce,ye,Se),R.setClearColor(J,me),He!==void 0&&(B.viewport=He),R.toneMapping=Ue}function yr(_,L,H){let B=L.isScene===!0?L.overrideMaterial:null;for(let z=0,ue=_.length;z<ue;z++){let xe=_[z],{object:ce,geometry:ye,group:Se}=xe,Ue=xe.material;Ue.allowOverride===!0&&B!==null&&(Ue=B),ce.layers.test(H.layers)&&uh(ce,L,H,ye,Ue,Se)}}function uh(_,L,H,B,z,ue){O!==null&&z.isNodeMaterial&&O.setObject(_,z),_.onBeforeRender(R,L,H,B,z,ue),_.modelViewMatrix.multiplyMatrices(H.matrixWorldInverse,_.matrixWorld),_.normalMatrix.getNormalMatrix(_.modelViewMatrix),z.onBeforeRender(R,L,H,B,_,ue),z.transparent===!0&&z.side===Gt&&z.forceSinglePass===!1?(z.side=Ct,z.needsUpdate=!0,R.renderBufferDirect(H,L,B,z,_,ue),z.side=li,z.needsUpdate=!0,R.renderBufferDirect(H,L,B,z,_,ue),z.side=Gt):R.renderBufferDirect(H,L,B,z,_,ue),_.onAfterRender(R,L,H,B,z,ue)}function dh(_){let L=0;for(let H of _)H.texture!==null&&L++;return L}function ps(_,L,H){L.isScene!==!0&&(L=Jt);let B=Re.get(_),z=w.state.lights,ue=w.state.shadowsArray,xe=z.state.version,ce=j.getParameters(_,z.state,ue,L,H,w.state.lightProbeGridArray),ye=j.getProgramCacheKey(ce),Se=B.programs;B.environment=_.isMeshStandardMaterial||_.isMeshLambertMaterial||_.isMeshPhongMaterial?L.environment:null,B.fog=L.fog;let Ue=_.isMeshStandardMaterial||_.isMeshLambertMaterial&&!_.envMap||_.isMeshPhongMaterial&&!_.envMap;B.envMap=A.get(_.envMap||B.environment,Ue),B.envMapRotation=B.environment!==null&&_.envMap===null?L.environmentRotation:_.envMapRotation,Se===void 0&&(_.addEventListener("dispose",Ke),Se=new Map,B.programs=Se,B.programVariants=new Map);let He=Se.get(ye);if(He!==void 0){if(B.currentProgram===He&&B.lightsStateVersion===xe)return ph(_,ce),He}else ce.uniforms=j.getUniforms(_),O!==null&&_.isNodeMaterial&&O.build(_,H,ce),_.onBeforeCompile(ce,R),He=j.acquireProgram(ce,ye),Se.set(ye,He),B.uniforms=ce.uniforms;let _e=B.uniforms;return(!_.isShaderMaterial&&!_.isRawShaderMaterial||_.clipping===!0)&&(_e.clippingPlanes=$.uniform),ph(_,ce),B.needsLights=Mf(_),B.lightsStateVersion=xe,B.needsLights&&(_e.ambientLightColor.value=z.state.ambient,_e.lightProbe.value=z.state.probe,_e.sunLights.value=z.state.sun,_e.sunLightShadows.value=z.state.sunShadow,_e.directionalLights.value=z.state.directional,_e.directionalLightShadows.value=z.state.directionalShadow,_e.spotLights.value=z.state.spot,_e.spotLightShadows.value=z.state.spotShadow,_e.rectAreaLights.value=z.state.rectArea,_e.ltc_1.value=z.state.rectAreaLTC1,_e.ltc_2.value=z.state.rectAreaLTC2,_e.pointLights.value=z.state.point,_e.pointLightShadows.value=z.state.pointShadow,_e.hemisphereLights.value=z.state.hemi,_e.sunShadowMatrix.value=z.state.sunShadowMatrix,_e.sunShadowCascade.value=z.state.sunShadowCascade,_e.directionalShadowMatrix.value=z.state.directionalShadowMatrix,_e.spotLightMatrix.value=z.state.spotLightMatrix,_e.spotLightMap.value=z.state.spotLightMap,_e.pointShadowMatrix.value=z.state.pointShadowMatrix),B.numLightProbeGrids=dh(w.state.lightProbeGridArray),B.currentProgram=He,B.uniformsList=null,He}function vf(_,L,H,B,z){let ue=Re.get(_),xe=ue.currentProgram.id+","+B+","+z,ce=ue.programVariants.get(xe);return ce===void 0?(ce=ps(_,L,H),ue.programVariants.set(xe,ce)):(ue.currentProgram=ce,ue.uniformsList=null,ue.outputColorSpace=B,ue.toneMapping=z),ce}function fh(_){if(_.uniformsList===null){let L=_.currentProgram.getUniforms();_.uniformsList=ls.seqWithValue(L.seq,_.uniforms)}return _.uniformsList}function ph(_,L){let H=Re.get(_);H.outputColorSpace=L.outputColorSpace,H.batching=L.batching,H.batchingColor=L.batchingColor,H.instancing=L.instancing,H.instancingColor=L.instancingColor,H.instancingMorph=L.instancingMorph,H.skinning=L.skinning,H.morphTargets=L.morphTargets,H.morphNormals=L.morphNormals,H.morphColors=L.morphColors,H.morphTargetsCount=L.morphTargetsCount,H.numClippingPlanes=L.numClippingPlanes,H.numIntersection=L.numClipIntersection,H.vertexAlphas=L.vertexAlphas,H.vertexTangents=L.vertexTangents,H.toneMapping=L.toneMapping}function _f(_,L,H,B,z){L.isScene!==!0&&(L=Jt),De.resetTextureUnits();let ue=L.fog,xe=B.isMeshStandardMaterial||B.isMeshLambertMaterial||B.isMeshPhongMaterial?L.environment:null,ce=ee===null?R.outputColorSpace:ee.isXRRenderTarget===!0?ee.texture.colorSpace:Xe.workingColorSpace,ye=B.isMeshStandardMaterial||B.isMeshLambertMaterial&&!B.envMap||B.isMeshPhongMaterial&&!B.envMap,Se=A.get(B.envMap||xe,ye),Ue=B.vertexColors===!0&&!!H.attributes.color&&H.attributes.color.itemSize===4,He=!!H.attributes.tangent&&(!!B.normalMap||B.anisotropy>0),_e=!!H.morphAttributes.position,We=!!H.morphAttributes.normal,ft=!!H.morphAttributes.color,tt=wn;B.toneMapped&&(ee===null||ee.isXRRenderTarget===!0)&&(tt=R.toneMapping);let et=H.morphAttributes.position||H.morphAttributes.normal||H.morphAttributes.color,Pt=et!==void 0?et.length:0,be=Re.get(B),Ut=w.state.lights;if(mt===!0&&(zt===!0||_!==Q)){let ct=_===Q&&B.id===X;$.setState(B,_,ct)}let $e=!1,ui=!1;B.version===be.__version?be.needsLights&&be.lightsStateVersion!==Ut.state.version||z.isBatchedMesh&&be.batching===!1||!z.isBatchedMesh&&be.batching===!0||z.isBatchedMesh&&be.batchingColor===!0&&z._colorsTexture===null||z.isBatchedMesh&&be.batchingColor===!1&&z._colorsTexture!==null||z.isInstancedMesh&&be.instancing===!1||!z.isInstancedMesh&&be.instancing===!0||z.isSkinnedMesh&&be.skinning===!1||!z.isSkinnedMesh&&be.skinning===!0||z.isInstancedMesh&&be.instancingColor===!0&&z.instanceColor===null||z.isInstancedMesh&&be.instancingColor===!1&&z.instanceColor!==null||z.isInstancedMesh&&be.instancingMorph===!0&&z.morphTexture===null||z.isInstancedMesh&&be.instancingMorph===!1&&z.morphTexture!==null||be.envMap!==Se||B.fog===!0&&be.fog!==ue||be.numClippingPlanes!==void 0&&(be.numClippingPlanes!==$.numPlanes||be.numIntersection!==$.numIntersection)||be.vertexAlphas!==Ue||be.vertexTangents!==He||be.morphTargets!==_e||be.morphNormals!==We||be.morphColors!==ft||be.morphTargetsCount!==Pt||be.numLightProbeGrids!==dh(w.state.lightProbeGridArray)?$e=!0:(be.outputColorSpace!==ce||be.toneMapping!==tt)&&(ui=!0):($e=!0,be.__version=B.version);let It=be.currentProgram;($e===!0||ui===!0)&&(It=ui===!0?vf(B,L,z,ce,tt):ps(B,L,z),O&&B.isNodeMaterial&&O.onUpdateProgram(B,It,be));let xr=!1,qn=!1,di=!1,Ye=It.getUniforms(),Tt=be.uniforms;if(de.useProgram(It.program)&&(xr=!0,qn=!0,di=!0),B.id!==X&&(X=B.id,qn=!0),xr||Q!==_){de.buffers.depth.getReversed()&&_.reversedDepth!==!0&&(_._reversedDepth=!0,_.updateProjectionMatrix()),Ye.setValue(F,"projectionMatrix",_.projectionMatrix),Ye.setValue(F,"viewMatrix",_.matrixWorldInverse);let bt=Ye.map.cameraPosition;bt!==void 0&&bt.setValue(F,yn.setFromMatrixPosition(_.matrixWorld)),ot.logarithmicDepthBuffer&&Ye.setValue(F,"logDepthBufFC",2/(Math.log(_.far+1)/Math.LN2)),(B.isMeshPhongMaterial||B.isMeshToonMaterial||B.isMeshLambertMaterial||B.isMeshBasicMaterial||B.isMeshStandardMaterial||B.isShaderMaterial)&&Ye.setValue(F,"isOrthographic",_.isOrthographicCamera===!0),Q!==_&&(Q=_,qn=!0,di=!0)}if(be.needsLights&&(Ut.state.sunShadowMap.length>0&&Ye.setValue(F,"sunShadowMap",Ut.state.sunShadowMap,De),Ut.state.directionalShadowMap.length>0&&Ye.setValue(F,"directionalShadowMap",Ut.state.directionalShadowMap,De),Ut.state.spotShadowMap.length>0&&Ye.setValue(F,"spotShadowMap",Ut.state.spotShadowMap,De),Ut.state.pointShadowMap.length>0&&Ye.setValue(F,"pointShadowMap",Ut.state.pointShadowMap,De)),z.isSkinnedMesh){Ye.setOptional(F,z,"bindMatrix"),Ye.setOptional(F,z,"bindMatrixInverse");let ct=z.skeleton;ct&&(ct.boneTexture===null&&ct.computeBoneTexture(),Ye.setValue(F,"boneTexture",ct.boneTexture,De))}z.isBatchedMesh&&(Ye.setOptional(F,z,"batchingTexture"),Ye.setValue(F,"batchingTexture",z._matricesTexture,De),Ye.setOptional(F,z,"batchingIdTexture"),Ye.setValue(F,"batchingIdTexture",z._indirectTexture,De),Ye.setOptional(F,z,"batchingColorTexture"),z._colorsTexture!==null&&Ye.setValue(F,"batchingColorTexture",z._colorsTexture,De));let on=H.morphAttributes;if((on.position!==void 0||on.normal!==void 0||on.color!==void 0)&&K.update(z,H,It),(qn||be.receiveShadow!==z.receiveShadow)&&(be.receiveShadow=z.receiveShadow,Ye.setValue(F,"receiveShadow",z.receiveShadow)),(B.isMeshStandardMaterial||B.isMeshLambertMaterial||B.isMeshPhongMaterial)&&B.envMap===null&&L.environment!==null&&(Tt.envMapIntensity.value=L.environmentIntensity),Tt.dfgLUT!==void 0&&(Tt.dfgLUT.value=_x()),qn){if(Ye.setValue(F,"toneMappingExposure",R.toneMappingExposure),be.needsLights&&bf(Tt,di),ue&&B.fog===!0&&re.refreshFogUniforms(Tt,ue),re.refreshMaterialUniforms(Tt,B,ge,Te,w.state.transmissionRenderTarget[_.id]),be.needsLights&&be.numLightProbeGrids>0){let ct=E,bt=0;for(let Tn of w.state.lightProbeGridArray)Tn.texture!==null&&(ct.textures[bt]=Tn.texture,ct.min[bt]=Tn.boundingBox.min,ct.max[bt]=Tn.boundingBox.max,ct.resolution[bt]=Tn.resolution,bt++);for(let Tn in ct)ct[Tn].length=bt;Tt.probesSH.value=ct.textures,Tt.probesMin.value=ct.min,Tt.probesMax.value=ct.max,Tt.probesResolution.value=ct.resolution}ls.upload(F,fh(be),Tt,De)}if(B.isShaderMaterial&&B.uniformsNeedUpdate===!0&&(ls.upload(F,fh(be),Tt,De),B.uniformsNeedUpdate=!1),B.isSpriteMaterial&&Ye.setValue(F,"center",z.center),Ye.setValue(F,"modelViewMatrix",z.modelViewMatrix),Ye.setValue(F,"normalMatrix",z.normalMatrix),Ye.setValue(F,"modelMatrix",z.matrixWorld),B.uniformsGroups!==void 0){let ct=B.uniformsGroups;for(let bt=0,Tn=ct.length;bt<Tn;bt++){let gh=ct[bt];we.update(gh,It),we.bind(gh,It)}}return It}function bf(_,L){_.ambientLightColor.needsUpdate=L,_.lightProbe.needsUpdate=L,_.sunLights.needsUpdate=L,_.sunLightShadows.needsUpdate=L,_.directionalLights.needsUpdate=L,_.directionalLightShadows.needsUpdate=L,_.pointLights.needsUpdate=L,_.pointLightShadows.needsUpdate=L,_.spotLights.needsUpdate=L,_.spotLightShadows.needsUpdate=L,_.rectAreaLights.needsUpdate=L,_.hemisphereLights.needsUpdate=L}function Mf(_){return _.isMeshLambertMaterial||_.isMeshToonMaterial||_.isMeshPhongMaterial||_.isMeshStandardMaterial||_.isShadowMaterial||_.isShaderMaterial&&_.lights===!0}this.getActiveCubeFace=function(){return W},this.getActiveMipmapLevel=function(){return G},this.getRenderTarget=function(){return ee},this.setRenderTargetTextures=function(_,L,H){let B=Re.get(_);B.__autoAllocateDepthBuffer=_.resolveDepthBuffer===!1,B.__autoAllocateDepthBuffer===!1&&(B.__useRenderToTexture=!1),Re.get(_.texture).__webglTexture=L,Re.get(_.depthTexture).__webglTexture=B.__autoAllocateDepthBuffer?void 0:H,B.__hasExternalTextures=!0},this.setRenderTargetFramebuffer=function(_,L){let H=Re.get(_);H.__webglFramebuffer=L,H.__useDefaultFramebuffer=L===void 0},this.setRenderTarget=function(_,L=0,H=0){ee=_,W=L,G=H;let B=null,z=!1,ue=!1;if(_){let ce=Re.get(_);if(ce.__useDefaultFramebuffer!==void 0){de.bindFramebuffer(F.FRAMEBUFFER,ce.__webglFramebuffer),te.copy(_.viewport),Me.copy(_.scissor),Fe=_.scissorTest,de.viewport(te),de.scissor(Me),de.setScissorTest(Fe),X=-1;return}else if(ce.__webglFramebuffer===void 0)De.setupRenderTarget(_);else if(ce.__hasExternalTextures)De.rebindTextures(_,Re.get(_.texture).__webglTexture,Re.get(_.depthTexture).__webglTexture);else if(_.depthBuffer){let Ue=_.depthTexture;if(ce.__boundDepthTexture!==Ue){if(Ue!==null&&Re.has(Ue)&&(_.width!==Ue.image.width||_.height!==Ue.image.height))throw new Error("THREE.WebGLRenderer: Attached DepthTexture is initialized to the incorrect size.");De.setupDepthRenderbuffer(_)}}let ye=_.texture;(ye.isData3DTexture||ye.isDataArrayTexture||ye.isCompressedArrayTexture)&&(ue=!0);let Se=Re.get(_).__webglFramebuffer;_.isWebGLCubeRenderTarget?(Array.isArray(Se[L])?B=Se[L][H]:B=Se[L],z=!0):_.samples>0&&De.useMultisampledRTT(_)===!1?B=Re.get(_).__webglMultisampledFramebuffer:Array.isArray(Se)?B=Se[H]:B=Se,te.copy(_.viewport),Me.copy(_.scissor),Fe=_.scissorTest}else te.copy(Pe).multiplyScalar(ge).floor(),Me.copy(Je).multiplyScalar(ge).floor(),Fe=Qe;if(H!==0&&(B=D),de.bindFramebuffer(F.FRAMEBUFFER,B)&&de.drawBuffers(_,B),de.viewport(te),de.scissor(Me),de.setScissorTest(Fe),z){let ce=Re.get(_.texture);F.framebufferTexture2D(F.FRAMEBUFFER,F.COLOR_ATTACHMENT0,F.TEXTURE_CUBE_MAP_POSITIVE_X+L,ce.__webglTexture,H)}else if(ue){let ce=L;for(let ye=0;ye<_.textures.length;ye++){let Se=Re.get(_.textures[ye]);F.framebufferTextureLayer(F.FRAMEBUFFER,F.COLOR_ATTACHMENT0+ye,Se.__webglTexture,H,ce)}}else if(_!==null&&H!==0){let ce=Re.get(_.texture);F.framebufferTexture2D(F.FRAMEBUFFER,F.COLOR_ATTACHMENT0,F.TEXTURE_2D,ce.__webglTexture,H)}X=-1};function mh(_){let L=Re.get(_);return(L.__readFormat!==_.format||L.__readType!==_.type)&&(L.__readFormat=_.format,L.__readType=_.type,L.__formatReadable=ot.textureFormatReadable(_.format),L.__typeReadable=ot.textureTypeReadable(_.type)),L}this.readRenderTargetPixels=function(_,L,H,B,z,ue,xe,ce=0){if(!(_&&_.isWebGLRenderTarget)){Le("WebGLRenderer.readRenderTargetPixels: renderTarget is not THREE.WebGLRenderTarget.");return}let ye=Re.get(_).__webglFramebuffer;if(_.isWebGLCubeRenderTarget&&xe!==void 0&&(ye=ye[xe],Array.isArray(ye)&&(ye=ye[0])),ye){de.bindFramebuffer(F.FRAMEBUFFER,ye);try{let Se=_.textures[ce],Ue=Se.format,He=Se.type;_.textures.length>1&&F.readBuffer(F.COLOR_ATTACHMENT0+ce);let _e=mh(Se);if(_e.__formatReadable===!1){Le("WebGLRenderer.readRenderTargetPixels: renderTarget is not in RGBA or implementation defined format.");return}if(_e.__typeReadable===!1){Le("WebGLRenderer.readRenderTargetPixels: renderTarget is not in UnsignedByteType or implementation defined type.");return}L>=0&&L<=_.width-B&&H>=0&&H<=_.height-z&&F.readPixels(L,H,B,z,se.convert(Ue),se.convert(He),ue)}finally{let Se=ee!==null?Re.get(ee).__webglFramebuffer:null;de.bindFramebuffer(F.FRAMEBUFFER,Se)}}},this.readRenderTargetPixelsAsync=async function(_,L,H,B,z,ue,xe,ce=0){if(!(_&&_.isWebGLRenderTarget))throw new Error("THREE.WebGLRenderer.readRenderTargetPixels: renderTarget is not THREE.WebGLRenderTarget.");let ye=Re.get(_).__webglFramebuffer;if(_.isWebGLCubeRenderTarget&&xe!==void 0&&(ye=ye[xe],Array.isArray(ye)&&(ye=ye[0])),ye)if(L>=0&&L<=_.width-B&&H>=0&&H<=_.height-z){de.bindFramebuffer(F.FRAMEBUFFER,ye);let Se=_.textures[ce],Ue=Se.format,He=Se.type;_.textures.length>1&&F.readBuffer(F.COLOR_ATTACHMENT0+ce);let _e=mh(Se);if(_e.__formatReadable===!1)throw new Error("THREE.WebGLRenderer.readRenderTargetPixelsAsync: renderTarget is not in RGBA or implementation defined format.");if(_e.__typeReadable===!1)throw new Error("THREE.WebGLRenderer.readRenderTargetPixelsAsync: renderTarget is not in UnsignedByteType or implementation defined type.");let We=F.createBuffer();F.bindBuffer(F.PIXEL_PACK_BUFFER,We),F.bufferData(F.PIXEL_PACK_BUFFER,ue.byteLength,F.STREAM_READ),F.readPixels(L,H,B,z,se.convert(Ue),se.convert(He),0),F.bindBuffer(F.PIXEL_PACK_BUFFER,null);let ft=ee!==null?Re.get(ee).__webglFramebuffer:null;de.bindFramebuffer(F.FRAMEBUFFER,ft);let tt=F.fenceSync(F.SYNC_GPU_COMMANDS_COMPLETE,0);return F.flush(),await qu(F,tt,4),F.bindBuffer(F.PIXEL_PACK_BUFFER,We),F.getBufferSubData(F.PIXEL_PACK_BUFFER,0,ue),F.bindBuffer(F.PIXEL_PACK_BUFFER,null),F.deleteBuffer(We),F.deleteSync(tt),ue}else throw new Error("THREE.WebGLRenderer.readRenderTargetPixelsAsync: requested read bounds are out of range.")},this.copyFramebufferToTexture=function(_,L=null,H=0){let B=Math.pow(2,-H),z=Math.floor(_.image.width*B),ue=Math.floor(_.image.height*B),xe=L!==null?L.x:0,ce=L!==null?L.y:0;De.setTexture2D(_,0),F.copyTexSubImage2D(F.TEXTURE_2D,H,0,0,xe,ce,z,ue),de.unbindTexture()},this.copyTextureToTexture=function(_,L,H=null,B=null,z=0,ue=0){let xe,ce,ye,Se,Ue,He,_e,We,ft,tt=_.isCompressedTexture?_.mipmaps[ue]:_.image;if(H!==null)xe=H.max.x-H.min.x,ce=H.max.y-H.min.y,ye=H.isBox3?H.max.z-H.min.z:1,Se=H.min.x,Ue=H.min.y,He=H.isBox3?H.min.z:0;else{let Ye=Math.pow(2,-z);xe=Math.floor(tt.width*Ye),ce=Math.floor(tt.height*Ye),_.isDataArrayTexture?ye=tt.depth:_.isData3DTexture?ye=Math.floor(tt.depth*Ye):ye=1,Se=0,Ue=0,He=0}B!==null?(_e=B.x,We=B.y,ft=B.z):(_e=0,We=0,ft=0);let et=se.convert(L.format),Pt=se.convert(L.type),be;L.isData3DTexture?(De.setTexture3D(L,0),be=F.TEXTURE_3D):L.isDataArrayTexture||L.isCompressedArrayTexture?(De.setTexture2DArray(L,0),be=F.TEXTURE_2D_ARRAY):(De.setTexture2D(L,0),be=F.TEXTURE_2D),de.activeTexture(F.TEXTURE0),de.pixelStorei(F.UNPACK_FLIP_Y_WEBGL,L.flipY),de.pixelStorei(F.UNPACK_PREMULTIPLY_ALPHA_WEBGL,L.premultiplyAlpha),de.pixelStorei(F.UNPACK_ALIGNMENT,L.unpackAlignment);let Ut=de.getParameter(F.UNPACK_ROW_LENGTH),$e=de.getParameter(F.UNPACK_IMAGE_HEIGHT),ui=de.getParameter(F.UNPACK_SKIP_PIXELS),It=de.getParameter(F.UNPACK_SKIP_ROWS),xr=de.getParameter(F.UNPACK_SKIP_IMAGES);de.pixelStorei(F.UNPACK_ROW_LENGTH,tt.width),de.pixelStorei(F.UNPACK_IMAGE_HEIGHT,tt.height),de.pixelStorei(F.UNPACK_SKIP_PIXELS,Se),de.pixelStorei(F.UNPACK_SKIP_ROWS,Ue),de.pixelStorei(F.UNPACK_SKIP_IMAGES,He);let qn=_.isDataArrayTexture||_.isData3DTexture,di=L.isDataArrayTexture||L.isData3DTexture;if(_.isDepthTexture){let Ye=Re.get(_),Tt=Re.get(L),on=Re.get(Ye.__renderTarget),ct=Re.get(Tt.__renderTarget);de.bindFramebuffer(F.READ_FRAMEBUFFER,on.__webglFramebuffer),de.bindFramebuffer(F.DRAW_FRAMEBUFFER,ct.__webglFramebuffer);for(let bt=0;bt<ye;bt++)qn&&(F.framebufferTextureLayer(F.READ_FRAMEBUFFER,F.COLOR_ATTACHMENT0,Re.get(_).__webglTexture,z,He+bt),F.framebufferTextureLayer(F.DRAW_FRAMEBUFFER,F.COLOR_ATTACHMENT0,Re.get(L).__webglTexture,ue,ft+bt)),F.blitFramebuffer(Se,Ue,Se+xe,Ue+ce,_e,We,_e+xe,We+ce,F.DEPTH_BUFFER_BIT,F.NEAREST);de.bindFramebuffer(F.READ_FRAMEBUFFER,null),de.bindFramebuffer(F.DRAW_FRAMEBUFFER,null)}else if(z!==0||_.isRenderTargetTexture||Re.has(_)){let Ye=Re.get(_),Tt=Re.get(L);de.bindFramebuffer(F.READ_FRAMEBUFFER,P),de.bindFramebuffer(F.DRAW_FRAMEBUFFER,V);for(let on=0;on<ye;on++)qn?F.framebufferTextureLayer(F.READ_FRAMEBUFFER,F.COLOR_ATTACHMENT0,Ye.__webglTexture,z,He+on):F.framebufferTexture2D(F.READ_FRAMEBUFFER,F.COLOR_ATTACHMENT0,F.TEXTURE_2D,Ye.__webglTexture,z),di?F.framebufferTextureLayer(F.DRAW_FRAMEBUFFER,F.COLOR_ATTACHMENT0,Tt.__webglTexture,ue,ft+on):F.framebufferTexture2D(F.DRAW_FRAMEBUFFER,F.COLOR_ATTACHMENT0,F.TEXTURE_2D,Tt.__webglTexture,ue),z!==0?F.blitFramebuffer(Se,Ue,Se+xe,Ue+ce,_e,We,_e+xe,We+ce,F.COLOR_BUFFER_BIT,F.NEAREST):di?F.copyTexSubImage3D(be,ue,_e,We,ft+on,Se,Ue,xe,ce):F.copyTexSubImage2D(be,ue,_e,We,Se,Ue,xe,ce);de.bindFramebuffer(F.READ_FRAMEBUFFER,null),de.bindFramebuffer(F.DRAW_FRAMEBUFFER,null)}else di?_.isDataTexture||_.isData3DTexture?F.texSubImage3D(be,ue,_e,We,ft,xe,ce,ye,et,Pt,tt.data):L.isCompressedArrayTexture?F.compressedTexSubImage3D(be,ue,_e,We,ft,xe,ce,ye,et,tt.data):F.texSubImage3D(be,ue,_e,We,ft,xe,ce,ye,et,Pt,tt):_.isDataTexture?F.texSubImage2D(F.TEXTURE_2D,ue,_e,We,xe,ce,et,Pt,tt.data):_.isCompressedTexture?F.compressedTexSubImage2D(F.TEXTURE_2D,ue,_e,We,tt.width,tt.height,et,tt.data):F.texSubImage2D(F.TEXTURE_2D,ue,_e,We,xe,ce,et,Pt,tt);de.pixelStorei(F.UNPACK_ROW_LENGTH,Ut),de.pixelStorei(F.UNPACK_IMAGE_HEIGHT,$e),de.pixelStorei(F.UNPACK_SKIP_PIXELS,ui),de.pixelStorei(F.UNPACK_SKIP_ROWS,It),de.pixelStorei(F.UNPACK_SKIP_IMAGES,xr),ue===0&&L.generateMipmaps===!0&&L.mipmapsAutoUpdate===!0&&F.generateMipmap(be),de.unbindTexture()},this.initRenderTarget=function(_){Re.get(_).__webglFramebuffer===void 0&&De.setupRenderTarget(_)},this.initTexture=function(_){_.isCubeTexture?De.setTextureCube(_,0):_.isData3DTexture?De.setTexture3D(_,0):_.isDataArrayTexture||_.isCompressedArrayTexture?De.setTexture2DArray(_,0):De.setTexture2D(_,0),de.unbindTexture()},this.resetState=function(){W=0,G=0,ee=null,de.reset(),oe.reset()},typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("observe",{detail:this}))}get coordinateSystem(){return tn}get outputColorSpace(){return this._outputColorSpace}set outputColorSpace(e){this._outputColorSpace=e;let t=this.getContext();t.drawingBufferColorSpace=Xe._getDrawingBufferColorSpace(e),t.unpackColorSpace=Xe._getUnpackColorSpace()}};var za=Math.PI/36;function Id(s,e){let t=new Map,n=()=>{if(t.size!==2)return null;let[r,o]=[...t.values()];return{x:.5*(r.x+o.x),y:.5*(r.y+o.y),apart:Math.hypot(r.x-o.x,r.y-o.y)}};s.addEventListener("pointerdown",r=>{r.target!==s&&!(r.target instanceof HTMLCanvasElement)||(t.set(r.pointerId,{x:r.clientX,y:r.clientY}),s.setPointerCapture(r.pointerId),s.dataset.held="")}),s.addEventListener("pointermove",r=>{let o=t.get(r.pointerId);if(!o)return;let a=Math.max(1,s.clientHeight),l=n(),c=r.clientX-o.x,h=r.clientY-o.y;o.x=r.clientX,o.y=r.clientY;let u=n();l&&u?(l.apart>0&&u.apart>0&&e.zoom(l.apart/u.apart),e.shift((l.x-u.x)/a,(u.y-l.y)/a)):r.shiftKey||r.buttons&6||e.panning?e.shift(-c/a,h/a):e.turn(-Math.PI*c/a,Math.PI*h/a)});let i=r=>{t.delete(r.pointerId),t.size===0&&delete s.dataset.held};for(let r of["pointerup","pointercancel","lostpointercapture"])s.addEventListener(r,i);s.addEventListener("contextmenu",r=>{r.target instanceof HTMLCanvasElement&&r.preventDefault()}),s.addEventListener("wheel",r=>{if(!r.ctrlKey&&!r.metaKey)return;r.preventDefault();let o=r.deltaMode===1?16:1;e.zoom(Math.exp(Math.min(.4,Math.max(-.4,.0016*o*r.deltaY))))},{passive:!1}),s.addEventListener("keydown",r=>{if(r.target!==s||r.ctrlKey||r.metaKey||r.altKey)return;let a={ArrowLeft:()=>r.shiftKey?e.shift(-.05,0):e.turn(-za,0),ArrowRight:()=>r.shiftKey?e.shift(.05,0):e.turn(za,0),ArrowUp:()=>r.shiftKey?e.shift(0,.05):e.turn(0,za),ArrowDown:()=>r.shiftKey?e.shift(0,-.05):e.turn(0,-za),"+":()=>e.zoom(1/1.15),"=":()=>e.zoom(1/1.15),"-":()=>e.zoom(1.15)}[r.key];a&&(r.preventDefault(),r.stopPropagation(),a())})}var bx=6,Mx=["x","y","z"],Va=6,hr=[[1,1],[-1,1],[1,-1],[-1,-1],[1,0],[-1,0],[0,1],[0,-1]],Ga=class{constructor(e,t,n){this.frames=e;this.reach=t;this.world=n;this.element.hidden=!0;let i=e.length<=bx;this.names=e.map(r=>({name:this.label(r.name,!1),letters:Mx.map(o=>this.label(o,!0))}));for(let{letters:r}of i?[]:this.names)for(let{element:o}of r)o.remove();this.lettered=i}frames;reach;world;element=Z("div",{class:"replay-labels","aria-hidden":"true"});names;lettered;width=1;height=1;point=new U;spot=new Float64Array(7);end=new Float64Array(3);label(e,t){let n=Z("span",t?{class:"replay-axis"}:{},e);return this.element.append(n),{element:n,text:e,letter:t,x:0,y:0,half:null,seen:!1,way:0}}resize(e,t){this.width=e,this.height=t;for(let{name:n}of this.names)n.half=null}place(e){let{spot:t,end:n}=this;for(let i=0;i<this.frames.length;i++){let{name:r,letters:o}=this.names[i];this.world.frame(t,this.frames[i].node,this.frames[i].pose),this.put(r,t,e);let[a,l]=[r.x,r.y];for(let c=0;c<3;c++)it(n,0,t,0,c===0?this.reach:0,c===1?this.reach:0,c===2?this.reach:0),this.put(o[c],n,e),this.move(o[c]);this.besides(r,a,l,o),this.move(r)}}besides(e,t,n,i){e.half??=[.5*e.element.offsetWidth+Va,.5*e.element.offsetHeight+Va];let[r,o]=e.half,a=-1/0,l=e.way;for(let c=0;c<hr.length;c++){let[h,u]=[t+hr[c][0]*r,n+hr[c][1]*o],f=c===e.way?Va:0,d=1/0;for(let g of i)for(let x of[.5,1]){let p=Math.abs(t+x*(g.x-t)-h)-r,m=Math.abs(n+x*(g.y-n)-u)-o;d=Math.min(d,Math.max(p,m))}f+=Math.min(d,3*Va),f>a&&(a=f,l=c)}e.way=l,e.x=t+hr[l][0]*r,e.y=n+hr[l][1]*o}put(e,t,n){let{point:i}=this;i.set(t[0],t[1],t[2]).project(n),e.seen=i.z<=1,e.x=.5*(1+i.x)*this.width,e.y=.5*(1-i.y)*this.height}move({element:e,x:t,y:n,seen:i}){e.style.visibility=i?"visible":"hidden",e.style.transform=`translate(${t.toFixed(1)}px,${n.toFixed(1)}px) translate(-50%,-50%)`}onto(e){let t=Z("canvas");t.width=e.width,t.height=e.height;let n=t.getContext("2d");if(!n)return null;n.drawImage(e,0,0);let i=e.width/this.width;Object.assign(n,{textAlign:"center",textBaseline:"middle",lineJoin:"round",strokeStyle:"#fff",fillStyle:"#1c222c",lineWidth:4*i});for(let{name:r,letters:o}of this.names)for(let{text:a,x:l,y:c,seen:h,letter:u}of[...this.lettered?o:[],r])h&&(n.font=`${u?600:400} ${12*i}px sans-serif`,n.strokeText(a,l*i,c*i),n.fillText(a,l*i,c*i));return t.toDataURL("image/png")}};var Sx=matchMedia("(prefers-reduced-motion: reduce)"),Ha=()=>Sx.matches;var wx=.9,Ex=260,Ax=["x","y","z","azimuth","elevation","distance"],Wa=class{constructor(e,t,n="fit"){this.extent=e;this.changed=t;this.camera.matrixAutoUpdate=!1,this.put(n,!1)}extent;changed;camera=new Ot(30,1,.01,100);panning=!1;preset="fit";now={x:0,y:0,z:0,azimuth:0,elevation:0,distance:1};from={...this.now};to={...this.now};eased=-1;followed=null;follows=!1;right=new U;up=new U;back=new U;basis=new je;resize(e,t){this.camera.aspect=e/Math.max(1,t),this.camera.updateProjectionMatrix(),this.preset?this.put(this.preset,!1):this.apply()}view(e){this.follows=!1,this.put(e,!Ha()),this.changed()}put(e,t){this.preset=e;let{side:n,flipped:i}=this.extent,o=(n===0?0:-Math.PI/2)+(i?Math.PI:0),a=0,l=0;e==="top"?(l=Math.PI/2,a=-o-Math.PI/2):e==="fit"?(a=this.extent.look?.turn??(n===2?-.5:.5),l=this.extent.look?.elevation??(n===2?.65:.36)):n===2&&(l=Math.PI/2),Object.assign(this.from,this.now);let c=this.to;c.azimuth=o+a,c.azimuth+=2*Math.PI*Math.round((this.now.azimuth-c.azimuth)/(2*Math.PI)),c.elevation=l,this.frame(c),t?this.eased=0:(this.eased=-1,Object.assign(this.now,c)),this.apply()}frame(e){this.axes(e);let{hull:t,centre:n}=this.extent,i=wx*Math.tan(this.camera.fov*Math.PI/360),r=i*this.camera.aspect,o=[-1/0,-1/0,-1/0,-1/0];for(let c=0;c<t.length;c+=4){let h=t[c]-n[0],u=t[c+1]-n[1],f=t[c+2]-n[2],d=h*this.right.x+u*this.right.y+f*this.right.z,g=h*this.up.x+u*this.up.y+f*this.up.z,x=h*this.back.x+u*this.back.y+f*this.back.z+t[c+3],p=t[c+3];o[0]=Math.max(o[0],d+p+x*r),o[1]=Math.max(o[1],-d+p+x*r),o[2]=Math.max(o[2],g+p+x*i),o[3]=Math.max(o[3],-g+p+x*i)}let a=.5*(o[0]-o[1]),l=.5*(o[2]-o[3]);e.distance=Math.max(.5*(o[0]+o[1])/r,.5*(o[2]+o[3])/i,.2*this.extent.radius),e.x=n[0]+a*this.right.x+l*this.up.x,e.y=n[1]+a*this.right.y+l*this.up.y,e.z=n[2]+a*this.right.z+l*this.up.z}axes(e){let{azimuth:t,elevation:n}=e;this.back.set(Math.cos(n)*Math.cos(t),Math.cos(n)*Math.sin(t),Math.sin(n)),this.right.set(-Math.sin(t),Math.cos(t),0),this.up.crossVectors(this.back,this.right)}ease(e){if(this.eased<0)return!1;this.eased=Math.min(1,this.eased+e/Ex);let t=this.eased*this.eased*(3-2*this.eased);for(let n of Ax)this.now[n]=this.from[n]+t*(this.to[n]-this.from[n]);return this.eased>=1&&(this.eased=-1),this.apply(),this.eased>=0}byHand(){this.preset=null,this.eased=-1}turn(e,t){this.byHand(),this.now.azimuth+=e,this.now.elevation=Math.min(Math.PI/2,Math.max(-Math.PI/2,this.now.elevation+t)),this.apply(),this.changed()}zoom(e){this.byHand();let{radius:t}=this.extent;this.now.distance=Math.min(40*t,Math.max(.1*t,this.now.distance*e)),this.apply(),this.changed()}shift(e,t){this.byHand(),this.axes(this.now);let n=2*this.now.distance*Math.tan(this.camera.fov*Math.PI/360),{right:i,up:r}=this,o=3*this.extent.radius;["x","y","z"].forEach((l,c)=>{let h=this.now[l]+n*(e*i[l]+t*r[l]),u=this.extent.centre[c];this.now[l]=Math.min(u+o,Math.max(u-o,h))}),this.apply(),this.changed()}get following(){return this.follows}follow(e){this.follows=e,this.followed=null,e&&this.byHand(),this.changed()}track(e){if(!this.follows)return;let{followed:t,now:n}=this;this.followed=[e[0],e[1],e[2]],!(!t||!(Math.hypot(e[0]-t[0],e[1]-t[1],e[2]-t[2])<20*this.extent.radius))&&(n.x+=e[0]-t[0],n.y+=e[1]-t[1],n.z+=e[2]-t[2],this.apply())}apply(){let{camera:e,now:t,right:n,up:i,back:r,basis:o}=this;this.axes(t),o.makeBasis(n,i,r),o.setPosition(t.x+t.distance*r.x,t.y+t.distance*r.y,t.z+t.distance*r.z),e.matrix.copy(o),e.matrixWorldNeedsUpdate=!0,e.updateMatrixWorld(!0);let a=Math.max(.02*t.distance,t.distance-6*this.extent.radius),l=t.distance+30*this.extent.radius;(e.near!==a||e.far!==l)&&(e.near=a,e.far=l,e.updateProjectionMatrix())}};function Ld(s,e){let t=devicePixelRatio,n=()=>{devicePixelRatio!==t&&(t=devicePixelRatio,e())},i=new ResizeObserver(n);try{i.observe(s,{box:"device-pixel-content-box"})}catch{}let r=setInterval(n,500);return()=>{i.disconnect(),clearInterval(r)}}var Tx=`
attribute vec3 from;
attribute vec3 to;
attribute vec2 along;
attribute vec2 order;
attribute vec3 tint;
uniform vec2 size;
uniform float width;
varying float vAlong;
varying float vOrder;
varying vec3 vTint;
void main() {
  vec4 a = modelViewMatrix * vec4(from, 1.0);
  vec4 b = modelViewMatrix * vec4(to, 1.0);
  float near = -1.0e-3;
  if (a.z > near && b.z < near) a.xyz = mix(a.xyz, b.xyz, (a.z - near) / (a.z - b.z));
  if (b.z > near && a.z < near) b.xyz = mix(b.xyz, a.xyz, (b.z - near) / (b.z - a.z));
  vec4 p = projectionMatrix * a;
  vec4 q = projectionMatrix * b;
  vec2 way = (q.xy / q.w - p.xy / p.w) * size;
  float length = max(length(way), 1.0e-4);
  way = length > 1.0e-3 ? way / length : vec2(1.0, 0.0);
  vec2 off = vec2(-way.y, way.x) * position.y + way * (2.0 * position.x - 1.0) * 0.5;
  gl_Position = position.x < 0.5 ? p : q;
  gl_Position.xy += off * width / size * gl_Position.w;
  vAlong = position.x < 0.5 ? along.x : along.y;
  vOrder = position.x < 0.5 ? order.x : order.y;
  vTint = tint;
}`,Rx=`
uniform vec3 colour;
uniform float tinted;
uniform float now;
uniform float dash;
varying float vAlong;
varying float vOrder;
varying vec3 vTint;
void main() {
  if (vOrder > now || (dash > 0.0 && fract(vAlong / dash) > 0.55)) discard;
  gl_FragColor = vec4(mix(colour, vTint, tinted), 1.0);
  #include <colorspace_fragment>
}`,$c=1e9,gn=class extends ht{constructor(e,t,n=!1,i=null){let r=e.length/3,o=Math.max(0,n?r/2:r-1),a=new Float32Array(6*o),l=new Float32Array(2*o),c=new Float32Array(2*o),h=new Float32Array(3*o),u=new U,f=0;for(let p=0;p<o;p++){let m=3*(n?2*p:p);for(let b=0;b<6;b++)a[6*p+b]=e[m+b];l[2*p]=f,f+=Math.hypot(e[m+3]-e[m],e[m+4]-e[m+1],e[m+5]-e[m+2]),l[2*p+1]=f,c[2*p]=p,c[2*p+1]=p+1,i?.[p]?.toArray(h,3*p)}for(let p=0;p<r;p++)u.set(u.x+e[3*p]/r,u.y+e[3*p+1]/r,u.z+e[3*p+2]/r);let d=0;for(let p=0;p<r;p++)d=Math.max(d,Math.hypot(e[3*p]-u.x,e[3*p+1]-u.y,e[3*p+2]-u.z));let g=new Ks;g.setAttribute("position",new nt([0,-1,0,1,-1,0,1,1,0,0,1,0],3)),g.setIndex([0,1,2,0,2,3]);let x=p=>{let m=new Float32Array(3*o);for(let b=0;b<o;b++)for(let T=0;T<3;T++)m[3*b+T]=a[6*b+p+T];return m};g.setAttribute("from",new kn(x(0),3)),g.setAttribute("to",new kn(x(3),3)),g.setAttribute("along",new kn(l,2)),g.setAttribute("order",new kn(c,2)),g.setAttribute("tint",new kn(h,3)),g.instanceCount=o,g.boundingSphere=new Bn(u,d),super(g,new Dt({vertexShader:Tx,fragmentShader:Rx,transparent:!0,depthWrite:!1,side:Gt,uniforms:{size:{value:new Be(1,1)},width:{value:t.width},colour:{value:new Ie},tinted:{value:i?1:0},now:{value:$c},dash:{value:t.dash??0}}}))}set colour(e){this.material.uniforms.colour.value.set(e)}leaveOut(e){let t=this.geometry.getAttribute("order");for(let n=0;n<t.count;n++)e(n)&&t.setXY(n,2*$c,2*$c);t.needsUpdate=!0}between(e,t){for(let[n,i]of[["from",e],["to",t]]){let r=this.geometry.getAttribute(n);r.setXYZ(0,i[0],i[1],i[2]),r.needsUpdate=!0}}set now(e){this.material.uniforms.now.value=e}resize(e,t){this.material.uniforms.size.value.set(e,t)}};var Xa=class{shaft;head;along=new U;across=new U;beside=new U;constructor(e,t,n,i,r=!1){this.shaft=t.line(new gn([0,0,0,0,0,1],{width:3}),n),this.shaft.frustumCulled=!1;let o=new Gs(.014*i,.036*i,14).rotateX(Math.PI/2).translate(0,0,-.018*i);this.head=new ht(o,t.glass()),this.head.matrixAutoUpdate=!1,this.head.renderOrder=n,r&&(this.shaft.material.depthTest=this.head.material.depthTest=!1),e.add(this.shaft,this.head),this.visible=!1}set visible(e){this.shaft.visible=this.head.visible=e}aim(e,t){let{along:n,across:i,beside:r,head:o}=this;n.set(t[0]-e[0],t[1]-e[1],t[2]-e[2]);let a=n.length();this.visible=a>0,a>0&&(this.shaft.between(e,t),n.divideScalar(a),i.set(Math.abs(n.z)<.9?0:1,0,Math.abs(n.z)<.9?1:0),r.crossVectors(n,i).normalize(),i.crossVectors(r,n).normalize(),o.matrix.makeBasis(i,r,n).setPosition(t[0],t[1],t[2]),o.matrixWorldNeedsUpdate=!0)}};var Cx=`
varying vec2 place;
void main() {
  vec4 world = modelMatrix * vec4(position, 1.0);
  place = world.xy;
  gl_Position = projectionMatrix * viewMatrix * world;
}`,Px=`
uniform vec3 colour;
uniform float pitch;
uniform vec2 middle;
uniform float reach;
varying vec2 place;
float lines(float every) {
  vec2 p = place / every;
  vec2 wide = fwidth(p);
  vec2 near = abs(fract(p - 0.5) - 0.5) / max(wide, vec2(1.0e-6));
  float fine = 1.0 - smoothstep(0.2, 0.6, max(wide.x, wide.y));
  return (1.0 - min(min(near.x, near.y), 1.0)) * fine;
}
void main() {
  float fade = 1.0 - smoothstep(0.35, 1.0, length(place - middle) / reach);
  float alpha = max(0.22 * lines(pitch), 0.5 * lines(5.0 * pitch)) * fade;
  if (alpha < 0.004) discard;
  gl_FragColor = vec4(colour, alpha);
  #include <colorspace_fragment>
}`,qa=class extends ht{constructor(e,t,n,i){let r=4*i;super(new Vn(2*r,2*r),new Dt({vertexShader:Cx,fragmentShader:Px,transparent:!0,depthWrite:!1,side:Gt,uniforms:{colour:{value:new Ie},pitch:{value:Fr(i)},middle:{value:new Be(e,t)},reach:{value:r}}})),this.position.set(e,t,n),this.renderOrder=-2}set colour(e){this.material.uniforms.colour.value.set(e)}};var Ix=1.4,Lx=30,Nx=3e4,Dx=`
uniform vec2 size;
uniform float width;
void main() {
  gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
  vec4 out4 = projectionMatrix * vec4(normalMatrix * normal, 0.0);
  vec2 way = (out4.xy * gl_Position.w - gl_Position.xy * out4.w) * size;
  float far = length(way);
  if (far > 1.0e-9) gl_Position.xy += 2.0 * width * way / far / size * gl_Position.w;
}`,Fx=`
uniform vec3 colour;
void main() {
  gl_FragColor = vec4(colour, 1.0);
  #include <colorspace_fragment>
}`,Ya=class{material=new Dt({vertexShader:Dx,fragmentShader:Fx,side:Ct,uniforms:{size:{value:new Be(1,1)},width:{value:Ix},colour:{value:new Ie}}});lines=new es({transparent:!0,depthWrite:!1});on(e){if(e.geometry.getAttribute("position").count>Nx)return;let t=new Os(new Hs(e.geometry,Lx),this.lines);t.matrixAutoUpdate=!1,t.renderOrder=e.renderOrder,e.add(t)}around(e){let t=new ht(e.geometry,this.material);t.matrixAutoUpdate=!1,e.add(t)}colour(e,t){this.material.uniforms.colour.value.set(e),this.lines.color.set(t)}resize(e,t){this.material.uniforms.size.value.set(e,t)}};function Ux(s){let{vertices:e,triangles:t}=s,n=new Float32Array(3*t.length);for(let r=0;r<t.length;r++)for(let o=0;o<3;o++)n[3*r+o]=e[3*t[r]+o];let i=new Et;return i.setAttribute("position",new Bt(n,3)),i.computeVertexNormals(),i}function Ox(s,e){switch(s.kind){case"box":return new ii(s.size[0],s.size[1],s.size[2]).toNonIndexed();case"cylinder":return new si(s.radius,s.radius,s.length,32).rotateX(Math.PI/2).toNonIndexed();case"capsule":return new Vs(s.radius,s.length,8,24).rotateX(Math.PI/2).toNonIndexed();case"sphere":return new sn(s.radius,28,18).toNonIndexed();case"mesh":return Ux(e[s.mesh])}}function Nd(s,e){let t=s.shapes.map(r=>{let[o,a,l,c,h,u,f]=r.pose,d=new nn(h,u,f,c).normalize();return Ox(r.solid,e).applyMatrix4(new je().compose(new U(o,a,l),d,new U(1,1,1)))}),n=t.reduce((r,o)=>r+o.getAttribute("position").array.length,0);if(n===0)return null;let i=new Et;for(let r of["position","normal"]){let o=new Float32Array(n),a=0;for(let l of t)o.set(l.getAttribute(r).array,a),a+=l.getAttribute(r).array.length;i.setAttribute(r,new Bt(o,3))}for(let r of t)r.dispose();return i.computeBoundingSphere(),i}function Zc(s,e){let n=s.filter((g,x)=>x===0||Bx(g,s[x-1])>1e-9);if(n.length<2){let[g,x,p]=n[0]??[0,0,0];return new sn(e,24,16).translate(g,x,p)}let i=n.slice(1).map((g,x)=>new U(g[0]-n[x][0],g[1]-n[x][1],g[2]-n[x][2]).normalize()),r=[],o=new U,a=new U,l=(g,x,p,m)=>{o.lengthSq()===0&&o.set(Math.abs(m.z)<.9?0:1,0,Math.abs(m.z)<.9?1:0),o.addScaledVector(m,-o.dot(m)),o.lengthSq()<1e-12&&o.set(m.y,m.z,m.x).addScaledVector(m,-(m.x*m.y+m.y*m.z+m.z*m.x)),o.normalize(),a.crossVectors(m,o);for(let b=0;b<16;b++){let T=x*Math.cos(2*Math.PI*b/16),E=x*Math.sin(2*Math.PI*b/16);r.push(g[0]+p*m.x+T*o.x+E*a.x,g[1]+p*m.y+T*o.y+E*a.y,g[2]+p*m.z+T*o.z+E*a.z)}},c=[0,.25,.5,.75,1];for(let g of c)l(n[0],e*Math.sin(g*Math.PI/2),-e*Math.cos(g*Math.PI/2),i[0]);for(let g=1;g+1<n.length;g++){let x=new U().addVectors(i[g-1],i[g]);l(n[g],e,0,x.lengthSq()>1e-6?x.normalize():i[g])}let h=i[i.length-1];for(let g of c)l(n[n.length-1],e*Math.cos(g*Math.PI/2),e*Math.sin(g*Math.PI/2),h);let u=r.length/3/16,f=[];for(let g=0;g+1<u;g++)for(let x=0;x<16;x++){let p=g*16+x,m=g*16+(x+1)%16;f.push(p,m,p+16,m,m+16,p+16)}let d=new Et;return d.setAttribute("position",new Bt(new Float32Array(r),3)),d.setIndex(f),d.computeVertexNormals(),d}function Bx(s,e){return Math.hypot(s[0]-e[0],s[1]-e[1],s[2]-e[2])}var kx=200,zx=.35,$a=class{constructor(e,t,n,i){this.replay=e;this.world=t;let{scene:r,lab:o}=this;this.frames=Dr(e);let a=n.radius;this.axis=.16*a,r.matrixAutoUpdate=!1,o.matrixAutoUpdate=!1,r.add(o),this.sun.position.set(n.centre[0]-.9*a,n.centre[1]-1.6*a,n.centre[2]+2.6*a),this.sun.target.position.set(...n.centre),this.sun.castShadow=!0;let l=this.sun.shadow;l.mapSize.set(1536,1536);let c=1.6*a;Object.assign(l.camera,{left:-c,right:c,top:c,bottom:-c,near:.5*a,far:6.5*a}),l.bias=-4e-4,l.normalBias=.004*a,this.sky.position.set(0,0,1),r.add(this.sun,this.sun.target,this.sky,this.fill),this.grid=new qa(n.centre[0],n.centre[1],n.ground,a),this.floor=new ht(new Vn(8*a,8*a),new Ws({depthWrite:!1})),this.floor.position.set(n.centre[0],n.centre[1],n.ground-.001*a),this.floor.receiveShadow=!0,this.floor.renderOrder=-3,r.add(this.grid,this.floor);let h=Or(e.nodes),u=0;e.nodes.forEach((M,w)=>{let y=Ir(e,M)?null:Nd(M,e.meshes);if(!y)return;let S=M.kind==="ghost",I=new ts;S&&Object.assign(I,{transparent:!0,opacity:.34,depthWrite:!1,polygonOffset:!0,polygonOffsetFactor:2,polygonOffsetUnits:8});let R=new ht(y,I);R.castShadow=!S,R.receiveShadow=!S,R.matrixAutoUpdate=!1,S&&(R.renderOrder=5+.01*u++),S?this.edges.on(R):this.edges.around(R),this.nodes.push({mesh:R,turn:h[w]}),M.track>=0&&this.moving.push({object:R,index:w}),this.put(R,w),r.add(R)});let f=Ri(e);if(f.length>0){let M=new si(.014*a,.014*a,1,16).rotateX(Math.PI/2).translate(0,0,.5),w=new sn(.024*a,18,12);f.forEach((y,S)=>{let I=new ts(y.ghost?{transparent:!0,opacity:.34,depthWrite:!1}:{}),R=[M,w].map(N=>{let O=new ht(N,I);return O.matrixAutoUpdate=!1,O.castShadow=!y.ghost,r.add(O),y.ghost?this.edges.on(O):this.edges.around(O),this.nodes.push({mesh:O,turn:y.ghost?"ghost":Cl(S)}),O});this.sticks.push({bone:y,stick:R[0],ball:R[1]})})}let d=(M,w)=>{let y=new Qi({transparent:!0,opacity:w,depthWrite:!1});return this.glasses.push({material:y,colour:M}),y},g=(M,w,y,S)=>{let I=new ht(w,y);return I.renderOrder=S,I.matrixAutoUpdate=!1,M.add(I),I},x=(M,w,y)=>(M.renderOrder=y,M.matrixAutoUpdate=!1,this.lines.push({line:M,colour:w}),M);for(let M of e.paths)M.zero!==null&&M.zero>0&&g(o,Zc(M.points,M.zero),d("path",.07),1),M.full!==null&&M.full>0&&g(o,Zc(M.points,M.full),d("path",.2),2),M.points.length>1&&o.add(x(new gn(M.points.flat(),{width:1.5}),"path",3));let p=new sn(.011*a,16,12);for(let M of e.goals){let[w,y,S]=M.position;M.zero!==null&&M.zero>0&&g(o,new sn(M.zero,32,24).translate(w,y,S),d("goal",.1),1),M.full!==null&&M.full>0&&g(o,new sn(M.full,24,18).translate(w,y,S),d("goal",.35),2),g(o,p.clone().translate(w,y,S),d("goal",.9),3)}let m=e.reference?.path;m&&m.count>1&&(o.add(x(new gn(m.values,{width:2,dash:.035*a}),"reference",5)),this.referenceDot=g(o,p,d("reference",1),6)),o.add(x(new gn(e.tcp.values,{width:2}),"future",4)),this.trail=x(new gn(e.tcp.values,{width:3.5}),"trail",6),o.add(this.trail),this.dot=g(o,p,d("trail",1),7),this.left=Li(e);for(let{off:M}of this.left){let w=x(new gn(e.tcp.values,{width:6,dash:.02*a}),"left",6.5);w.leaveOut(y=>!M[y]),o.add(w),this.off.push(w)}let b=(M,w,y,S=!1)=>{let I={line:(R,N)=>x(R,w,N),glass:()=>d(w,1)};return new Xa(M,I,y,a,S)};this.left.length>0&&(this.arrow=b(o,"left",7)),this.velocity=new Ni(e,a),this.wanted=b(o,"wanted",7.2),this.moved=b(o,"velocity",7.3);let T=new sn(1,20,14);for(let M of Pi(e,kx)){let w=d("contact",1);w.depthTest=!1;let y=g(r,T,w,8),S=.014*a*M.size;y.matrix.makeScale(S,S,S).setPosition(M.point[0],M.point[1],M.point[2]),y.matrixWorldNeedsUpdate=!0;let{force:I,point:R}=M,N=I?b(r,"contact",8.5,!0):null;I&&N?.aim(R,R.map((O,D)=>O+zx*a*I[D])),this.contacts.push({mesh:y,mark:M,arrow:N})}let E=[new U(1,0,0),new U(0,1,0),new U(0,0,1)].map(M=>M.multiplyScalar(this.axis));for(let M of this.frames){let w=E.flatMap(S=>[0,0,0,...S.toArray()]),y=new gn(w,{width:2.5},!0,i.axes.map(S=>new Ie(S)));y.material.depthTest=!1,y.renderOrder=9,y.matrixAutoUpdate=!1,y.visible=!1,r.add(y),this.axes.push({line:y,node:M.node})}this.colour(i),this.pose()}replay;world;scene=new Ns;frames;axis;lab=new Dn;nodes=[];edges=new Ya;moving=[];sticks=[];contacts=[];lines=[];glasses=[];trail;dot;left;off=[];arrow=null;velocity;moved;wanted;moves=!1;tip=new Float64Array(3);referenceDot=null;axes=[];grid;sun=new Zs;sky=new qs;fill=new Js;floor;spot=new Float64Array(7);along=new U;across=new U;beside=new U;put(e,t){this.write(e,this.world.poses,7*t)}write(e,t,n){let i=t[n+3],r=t[n+4],o=t[n+5],a=t[n+6];e.matrix.set(1-2*(o*o+a*a),2*(r*o-i*a),2*(r*a+i*o),t[n],2*(r*o+i*a),1-2*(r*r+a*a),2*(o*a-i*r),t[n+1],2*(r*a-i*o),2*(o*a+i*r),1-2*(r*r+o*o),t[n+2],0,0,0,1),e.matrixWorldNeedsUpdate=!0}pose(){let{world:e}=this;for(let i=0;i<this.moving.length;i++)this.put(this.moving[i].object,this.moving[i].index);for(let i=0;i<this.sticks.length;i++)this.stretch(this.sticks[i].bone,this.sticks[i].stick,this.sticks[i].ball);e.there&&this.leaveOut(e),this.write(this.lab,e.lab,0),this.trail.now=e.progress;for(let i of this.off)i.now=e.progress;this.dot.matrix.setPosition(e.tcp[0],e.tcp[1],e.tcp[2]),this.dot.matrixWorldNeedsUpdate=!0,this.arrow&&this.point(this.arrow),this.drawVelocities();let t=this.replay.reference;if(t&&this.referenceDot){let{values:i,count:r}=t.path,o=Math.min(r-1,Math.max(0,e.t/t.periodS)),a=Math.floor(o),l=Math.min(r-1,a+1),c=o-a;this.referenceDot.matrix.setPosition(i[3*a]+c*(i[3*l]-i[3*a]),i[3*a+1]+c*(i[3*l+1]-i[3*a+1]),i[3*a+2]+c*(i[3*l+2]-i[3*a+2])),this.referenceDot.matrixWorldNeedsUpdate=!0}let n=e.t/this.replay.stepS;for(let i=0;i<this.contacts.length;i++){let{mesh:r,mark:o,arrow:a}=this.contacts[i],l=Cr(o,n);r.visible=l>0,r.material.opacity=l,a&&(a.visible=l>0)}if(this.axes.length&&this.axes[0].line.visible){let{frames:i}=this;for(let r=0;r<this.axes.length;r++)e.frame(this.spot,i[r].node,i[r].pose),this.write(this.axes[r].line,this.spot,0)}}point(e){let{world:t,spot:n}=this,i=Nr(this.left,t.progress);if(!i){e.visible=!1;return}_s(n,i.path,t.tcp),e.aim(t.tcp,n)}drawVelocities(){let{moved:e,wanted:t,velocity:n,tip:i,world:r}=this;e.visible=t.visible=!1,this.moves&&(n.actual(i,r.progress),n.tip(i,r.tcp),e.aim(r.tcp,i),n.wanted(i,r.progress)&&(n.tip(i,r.tcp),t.aim(r.tcp,i)))}leaveOut(e){for(let{object:t,index:n}of this.moving)t.visible=e.there?.(n)??!0;for(let{bone:t,stick:n,ball:i}of this.sticks)n.visible=i.visible=e.there?.(t.to)??!0}stretch(e,t,n){let{poses:i}=this.world,r=7*e.from;Ci(this.spot,this.world,e);let{along:o,across:a,beside:l}=this;o.set(this.spot[0]-i[r],this.spot[1]-i[r+1],this.spot[2]-i[r+2]);let c=o.length();a.set(Math.abs(o.z)<.9*c?0:1,0,Math.abs(o.z)<.9*c?1:0),l.crossVectors(o,a).normalize(),a.crossVectors(l,o).normalize(),t.matrix.makeBasis(a,l,o).setPosition(i[r],i[r+1],i[r+2]),t.matrixWorldNeedsUpdate=!0,n.matrix.setPosition(this.spot[0],this.spot[1],this.spot[2]),n.matrixWorldNeedsUpdate=!0}resize(e,t){for(let{line:n}of this.lines)n.resize(e,t);for(let{line:n}of this.axes)n.resize(e,t);this.edges.resize(e,t)}show(e,t){if(e==="frames")for(let{line:n}of this.axes)n.visible=t;else if(e==="shadows")this.sun.castShadow=t,this.floor.visible=t;else if(e==="velocity")this.moves=t;else for(let{mesh:n,turn:i}of this.nodes)i==="ghost"&&(n.visible=t)}colour(e){for(let{mesh:t,turn:n}of this.nodes)t.material.color.set(Oh(e,n));this.edges.colour(e.edge,e.ghost);for(let{line:t,colour:n}of this.lines)t.colour=e[n];for(let{material:t,colour:n}of this.glasses)t.color.set(e[n]);for(let{line:t}of this.axes){let n=t.geometry.getAttribute("tint");e.axes.forEach((i,r)=>{let{r:o,g:a,b:l}=new Ie(i);n.setXYZ(r,o,a,l)}),n.needsUpdate=!0}this.grid.colour=e.grid,this.sky.color.set(e.sky),this.sky.groundColor.set(e.earth),this.sky.intensity=e.light[0],this.fill.intensity=.25,this.sun.intensity=e.light[1],this.floor.material.opacity=e.shadow}forget(){this.sun.shadow.map?.dispose(),this.sun.shadow.map=null,this.scene.traverse(e=>{let{geometry:t,material:n}=e;t?.dispose();for(let i of[n??[]].flat())i.dispose()})}};var Vx=2,Gx=.6,Hx=45,Dd=1e3,Wx=10,Xx=2,qx=50,Yx=12,$x=640,Zx=250,Jx=4e3,Kx=4,jx=6e4,Ei=class{constructor(e,t,n,i,r,o="fit"){this.world=t;this.lost=r;this.element=Z("div",{class:"replay-stage",tabindex:"0",role:"application","aria-roledescription":"3D view","aria-label":i}),this.scene=new $a(e,t,n,Ur()),this.labels=new Ga(this.scene.frames,1.1*this.scene.axis,t),this.element.append(this.labels.element),this.camera=new Wa(n,()=>this.invalidate(),o),Id(this.element,this.camera);let a=new ResizeObserver(()=>this.resize());a.observe(this.element);let l=new IntersectionObserver(h=>this.approach(h[h.length-1].isIntersecting),{rootMargin:"300px"});l.observe(this.element);let c=new IntersectionObserver(h=>!h[h.length-1].isIntersecting&&this.release(),{rootMargin:"2500px"});c.observe(this.element),this.undo.push(()=>a.disconnect(),()=>l.disconnect(),()=>c.disconnect(),Ld(this.element,()=>this.resize()),Uh(()=>{this.scene.colour(Ur()),this.invalidate()}))}world;lost;element;camera;scene;labels;drawn=null;waits=0;losses=0;lossAt=0;near=!1;last=0;beaten=0;late=0;slow=0;coarse=!1;settles=0;pixels=0;width=0;height=0;parts={shadows:!0,frames:!1,ghost:!0,velocity:!1};undo=[];point=new U;drawnOver;tooSlow;approach(e){this.near=e,e&&this.open()}open(){if(this.drawn)return;let e=Z("canvas",{"aria-hidden":"true"}),t=new AbortController,n={signal:t.signal};e.addEventListener("webglcontextlost",o=>this.waitFor(o),n),e.addEventListener("webglcontextrestored",o=>this.regain(o),n);let i=e.getContext("webgl2",{alpha:!0,antialias:!0,depth:!0,stencil:!1,powerPreference:"low-power"});if(!i){this.giveUp();return}let r=new Oa({canvas:e,context:i});r.shadowMap.enabled=!0,r.shadowMap.type=vi,r.setClearAlpha(0),this.element.prepend(e),this.drawn={renderer:r,canvas:e,heard:t},this.resize()}release(){if(!this.drawn)return;let{renderer:e,canvas:t,heard:n}=this.drawn;this.drawn=null,clearTimeout(this.waits),this.waits=0,n.abort(),this.end(e);let i=e.getContext();i.isContextLost()||i.getExtension("WEBGL_lose_context")?.loseContext(),t.remove()}end(e){clearTimeout(this.settles),this.coarse=!1,this.scene.forget(),e.dispose()}waitFor(e){if(e.preventDefault(),e.stopImmediatePropagation(),!this.drawn)return;let t=performance.now();this.losses=t-this.lossAt>jx?1:this.losses+1,this.lossAt=t,this.near?this.losses>Kx?this.giveUp():(this.end(this.drawn.renderer),this.waits=window.setTimeout(()=>this.giveUp(),Jx)):this.release()}regain(e){if(e.stopImmediatePropagation(),!this.drawn||!this.waits)return;this.drawn.heard.abort(),this.drawn.canvas.remove();let t=this.drawn.renderer.getContext();this.drawn=null,clearTimeout(this.waits),this.waits=0,t.getExtension("WEBGL_lose_context")?.loseContext(),this.open()}giveUp(){this.dispose(),this.lost()}dispose(){this.release();for(let e of this.undo)e();this.undo.length=0}resize(){let{clientWidth:e,clientHeight:t}=this.element;!this.drawn||this.waits||e===0||t===0||(this.width=e,this.height=t,this.scene.resize(e,t),this.camera.resize(e,t),this.labels.resize(e,t),this.sharpen(!1))}show(e,t){this.parts[e]=t,this.scene.show(e,t),this.labels.element.hidden=!this.parts.frames,this.invalidate()}sharpen(e,t=0){if(!this.drawn||this.waits)return;let{renderer:n}=this.drawn;this.coarse=e,this.late=0,this.pixels=devicePixelRatio;let i=Math.max(Gx,Math.min(Vx,this.pixels)/(e?Xx:1),t/this.width);n.setPixelRatio(i),n.setSize(this.width,this.height),this.draw(performance.now())}invalidate(){this.drawn&&Ii(this.draw)}draw=e=>{if(!this.drawn||this.waits||this.width===0)return;if(devicePixelRatio!==this.pixels)return this.sharpen(!1);clearTimeout(this.settles),e!==this.beaten&&(this.late=this.slow=0);let t=this.camera.ease(Math.min(50,e-this.last));this.last=e,Ii(this.beat),t&&Ii(this.draw),this.scene.pose(),this.camera.track(this.world.tcpInWorld),this.drawn.renderer.render(this.scene.scene,this.camera.camera),this.parts.frames&&this.labels.place(this.camera.camera),this.drawnOver?.(this.project)};project=(e,t)=>{let{point:n}=this;return n.set(t[0],t[1],t[2]).project(this.camera.camera),e[0]=.5*(1+n.x)*this.width,e[1]=.5*(1-n.y)*this.height,n.z<=1};beat=e=>{let t=e-this.last;if(this.beaten=e,this.late=t>Hx&&t<Dd?this.late+1:0,this.slow=t>qx&&t<Dd?this.slow+1:0,this.slow>=Yx&&this.parts.shadows){let n=this.tooSlow;this.tooSlow=void 0,n?.()}this.coarse?this.settles=window.setTimeout(()=>this.sharpen(!1),Zx):this.late>=Wx&&(this.coarse=!0,setTimeout(()=>this.coarse&&this.sharpen(!0)))};picture(){let e=this.drawn===null;if(e&&this.open(),!this.drawn||this.waits||this.width===0)return e&&this.release(),null;let{renderer:t,canvas:n}=this.drawn;this.scene.colour(Rl),t.setClearColor(16777215,1),this.sharpen(!1,$x);let i=this.parts.frames?this.labels.onto(n):n.toDataURL("image/png");return t.setClearColor(16777215,0),this.scene.colour(Ur()),e?this.release():this.sharpen(!1),i}};var Za=null;function Ja(){if(Za===null)try{let s=document.createElement("canvas").getContext("webgl2");Za=s!==null,s?.getExtension("WEBGL_lose_context")?.loseContext()}catch{Za=!1}return Za}var Ka=class{constructor(e,t){this.data=t;let n=new Tr(t);this.world=n,this.extent=Rr(n.scenery,n),this.scale=n.velocityScale(),this.marks=new vr(n,this.scale),this.on={branches:t.branches&&n.hasBranches,jacobian:t.jacobian,ellipse:!1},this.joints=t.chain.q.map((r,o)=>new Sr(t.chain,o,a=>this.put([...n.q].map((l,c)=>c===o?a:l)))),this.note.hidden=!0,this.views=this.cameraButtons(),this.view=this.open();let i=Z("div",{class:"arm-joints",role:"group","aria-label":"Joints"},...this.joints.map(r=>r.element));e.append(this.view.element,Z("div",{class:"replay-beside"},this.readout(),this.words()),Z("div",{class:"replay-below"},this.note,i,this.controls())),e.setAttribute("role","group"),e.setAttribute("aria-label",`The arm ${t.name}, which you can move`),e.classList.add("replay","on"),this.marks.jacobian=this.on.jacobian,n.seekBranches(this.on.branches),this.put(n.start()),this.view instanceof an&&this.sayFlat("This browser shows no WebGL")}data;world;extent;marks;joints;tcp=[];q=[];scale;said=new Map;on;note=Z("p",{class:"replay-note"});views;view;open(){let{scenery:e}=this.world,t=this.world.space.basis.length<3?"side":"fit",n="The arm in 3D. Arrow keys turn the view, with Shift they move it, plus and minus zoom.";return this.ready(Ja()?new Ei(e,this.world,this.extent,n,()=>this.fall(),t):this.side())}side(){return new an(this.world.scenery,this.world,this.extent,"The arm, seen from the side")}ready(e){return e.drawnOver=t=>this.marks.draw(t),e.element.append(this.marks.element),e.show("frames",!0),e.invalidate(),e}fall(){if(this.view instanceof an)return;let e=this.view.element;this.view=this.ready(this.side()),e.replaceWith(this.view.element),this.sayFlat("The 3D view was lost")}sayFlat(e){this.note.textContent=`${e}, so the arm is drawn flat, seen from the side.`,this.note.hidden=!1,this.views.hidden=!0}put(e){this.world.put(e),this.write(),this.view.invalidate()}readout(){let e=(r,o)=>Z("table",{"data-readout":o},Z("caption",{},r)),t=(r,o,a,l)=>{let c=Z("span");l.push(c),r.append(Z("tr",{},Z("th",{scope:"row"},Z("bdi",{},o)),Z("td",{},c),Z("td",{},a)))},n=e(`TCP in the frame ${this.data.labName}`,"tcp");for(let r of["x","y","z"])t(n,r,"m",this.tcp);let i=e("Joint positions q","q");return this.data.chain.q.forEach(({name:r,unit:o})=>t(i,r,o,this.q)),Z("div",{class:"replay-readout"},n,i)}words(){let e=Z("div",{class:"arm-words"});for(let t of["branches","jacobian","ellipse"]){let n=Z("p",{"data-arm-words":t});this.said.set(t,n),e.append(n)}return e}controls(){let e=Z("div",{role:"group","aria-label":"Show",class:"replay-group"}),t=(i,r)=>{let o=Z("button",{type:"button",class:"replay-word","data-switch":i,"aria-pressed":String(this.on[i])},r);o.addEventListener("click",()=>{this.on[i]=!this.on[i],o.setAttribute("aria-pressed",String(this.on[i])),this.marks.jacobian=this.on.jacobian,this.marks.ellipse=this.on.ellipse,i==="branches"&&this.world.seekBranches(this.on.branches),this.put(this.world.q)}),e.append(o)};this.world.hasBranches&&t("branches","Other branches"),this.world.space.active.length>0&&t("jacobian","Columns of the Jacobian"),this.world.hasEllipse&&t("ellipse","Manipulability");let n=Z("button",{type:"button",class:"replay-word"},"Back to the start");return n.addEventListener("click",()=>this.put(this.world.start())),Z("div",{class:"replay-controls"},e,this.views,n)}cameraButtons(){let e=Z("div",{role:"group","aria-label":"View",class:"replay-group"});for(let[t,n]of[["Side","side"],["Above","top"],["Slanted","fit"]]){let i=Z("button",{type:"button",class:"replay-word"},t);i.addEventListener("click",()=>this.view.camera?.view(n)),e.append(i)}return e}write(){let{world:e,said:t}=this;for(let i=0;i<3;i++)this.tcp[i].textContent=Mt(e.tcp[i],4);e.q.forEach((i,r)=>{this.q[r].textContent=Mt(i,4),this.joints[r].show(i)});let n={branches:()=>this.branchWords(),jacobian:()=>`Arrows: how the TCP moves while one joint alone moves at ${this.speeds()}. 1 m/s is drawn ${this.scale} m long.`,ellipse:()=>this.ellipseWords()};for(let[i,r]of t)r.hidden=!this.on[i],this.on[i]&&(r.textContent=n[i]())}speeds(){return[...new Set(this.data.chain.q.map(({unit:t})=>`1 ${t}/s`))].join(" or ")}branchWords(){let{others:e,endless:t}=this.world.branches;return t?"Other branches: infinitely many postures have this TCP.":e.length===0?"Other branches: none. Only this posture has this TCP.":`Other branches: ${e.length===1?"one more posture has":`${e.length} more postures have`} the same TCP, drawn translucent.`}ellipseWords(){let e=this.world.ellipse(),t=Eh(e),n={singular:"singular: there is a direction in which the TCP cannot move","nearly singular":"nearly singular: in one direction the TCP moves slowly","not singular":"not singular: the TCP can move in every direction"}[t],i=this.world.space.basis.length===3?"ellipsoid":"ellipse";return`Manipulability \u221Adet(J J\u1D40) = ${Mt(e.manipulability,4)}, ${n}. The ${i} has all velocities of the TCP for joint speeds of length 1.`}shown(){let{world:e,data:t}=this,n={};return t.nodes.forEach(({name:i},r)=>n[i]??=[...e.poses.subarray(7*r,7*r+7)]),{q:[...e.q],tcp:[...e.tcp],poses:n,others:e.branches.others.map(i=>[...i]),jacobian:e.columns(),manipulability:e.hasEllipse?e.ellipse().manipulability:null}}};var ja=class{constructor(e,t,n){this.ticks=e;this.track=t;this.within=n}ticks;track;within;row=0;rows=new Int32Array(4);weights=new Float64Array(4);find(e){let t=this.ticks,n=t.length-1,i=this.row;return t[i]<=e&&(i===n||e<t[i+1])?i:i<n&&t[i+1]<=e&&(i+1===n||e<t[i+2])?i+1:Jc(t,e)}at(e){let{ticks:t,rows:n,weights:i}=this,r=this.row=this.find(e),o=t.length-1,a=Math.min(r+1,o);n[0]=Math.max(r-1,0),n[1]=r,n[2]=a,n[3]=Math.min(a+1,o);let l=t[a]-t[r],c=a>r?Math.min(1,Math.max(0,(e-t[r])/l)):0,h=t[r]-t[n[0]],u=t[n[3]]-t[a],f=h>0?h/(h+l):1,d=u>0?u/(u+l):1,g=h>0?(1-f)*(l/h):0,x=u>0?(1-d)*(l/u):0,p=c*(1-c)*(1-c),m=-c*c*(1-c),b=c*c*(3-2*c);i[0]=-p*g,i[1]=1-b+p*(g-f)-m*d,i[2]=b+p*f+m*(d-x),i[3]=m*x}get isFrame(){return this.weights[1]===1||this.weights[2]===1}number(e){let{rows:t,weights:n}=this,{values:i,width:r}=this.track;return n[0]*i[t[0]*r+e]+n[1]*i[t[1]*r+e]+n[2]*i[t[2]*r+e]+n[3]*i[t[3]*r+e]}pose(e,t){for(let n=0;n<7;n++)e[t+n]=this.number(n);xn(e,t)}};function Jc(s,e){let t=0,n=s.length-1;for(;t<n;){let i=t+n+1>>1;s[i]<=e?t=i:n=i-1}return t}function el(s){let e=Uint8Array.fromBase64;if(e)return e(s);let t=atob(s),n=new Uint8Array(t.length);for(let i=0;i<t.length;i++)n[i]=t.charCodeAt(i);return n}var Qa=class{constructor(e){this.data=e}data;at=0;get done(){return this.at>=this.data.length}next(){let e=this.data,t=e[this.at++];if(t<128)return t&1?-(t+1>>1):t>>1;let n=t&127,i=128;do{if(this.at>=e.length)throw new Error("a number ends before its last byte");if(i>2**49)throw new Error("a number is longer than 53 bits");t=e[this.at++],n+=(t&127)*i,i*=128}while(t>=128);return n%2?-(n+1)/2:n/2}};function Fd(s){let e=el(s),t=new Qa(e),n=new Float64Array(e.length),i=0,r=0,o=0;for(;!t.done;){let a=t.next();i===0?r=a:(o+=a,r+=o),n[i++]=r}return n.subarray(0,i)}function Ud(s,e,t,n){let i=e.length,r=el(s);if(r.length<i*t)throw new Error(`${r.length} bytes hold no ${i} columns of ${t} numbers`);let o=new Qa(r),a=new Float64Array(i*t);for(let l=0;l<i;l++){let c=e[l],h=0,u=0;for(let f=0,d=l;f<t;f++,d+=i){if(o.at>=r.length)throw new Error(`column ${l+1} of ${i} ends after ${f} of ${t} numbers`);let g=r[o.at],x;g<128?(o.at++,x=g>>1^-(g&1)):x=o.next();let p=h;if(f<2)h+=x;else{let m=n===null?1:(n[f]-n[f-1])/(n[f-1]-n[f-2]);h+=Math.floor(u*m+.5)+x}u=h-p,a[d]=h*c}}if(!o.done)throw new Error(`there are more than ${i} columns of ${t} numbers`);return{width:i,count:t,values:a}}var Qx=["link","fixed","driven","free","ghost"],ev=["contact","limit","saturation","breach","fell","stop","other"],tv=1e6;function dr(s){return s.ghostLabel===null||s.ghostLabel==="reference"}var ur=class s{constructor(e,t){this.value=e;this.where=t}value;where;wrong(e){return new Error(`${this.where||"the data"} is not ${e}`)}get missing(){return this.value===null||this.value===void 0}of(e){if(typeof this.value!="object"||this.value===null)throw this.wrong("a record");return new s(this.value[e],this.where?`${this.where}.${e}`:e)}number(){if(typeof this.value!="number"||!Number.isFinite(this.value))throw this.wrong("a number");return this.value}yes(){if(typeof this.value!="boolean")throw this.wrong("yes or no");return this.value}positive(){let e=this.number();if(!(e>0))throw this.wrong("a positive number");return e}index(e){let t=this.number();if(!Number.isInteger(t)||t<0||t>=e)throw this.wrong(`one of ${e}`);return t}text(){if(typeof this.value!="string")throw this.wrong("a text");return this.value}list(e){if(!Array.isArray(this.value))throw this.wrong("a list");return this.value.map((t,n)=>e(new s(t,`${this.where}[${n}]`)))}numbers(e){let t=this.list(n=>n.number());if(t.length!==e)throw this.wrong(`${e} numbers`);return t}pose(){let e=this.numbers(7);if(!(Math.hypot(e[3],e[4],e[5],e[6])>1e-6))throw this.wrong("a pose");return e}maybe(e){return this.missing?null:e(this)}one(e,t){return e.find(i=>i===this.value)??t}track(e,t){let n=this.of("quanta").numbers(this.of("width").number());if(n.length!==e)throw this.wrong(`${e} columns`);let i=this.of("count").number();if(!Number.isInteger(i)||i<0)throw this.wrong("a track: its count is no count");if(t!==null&&i!==t.length)throw this.wrong(`a track of ${t.length} frames`);return this.decoded(()=>Ud(this.of("data").text(),n,i,t))}ticks(){let e=this.decoded(()=>Fd(this.text()));if(e.length===0)throw this.wrong("a list of ticks: there is none");for(let t=1;t<e.length;t++)if(!(e[t]>e[t-1]))throw this.wrong("in order of time");return e}way(e){let t=this.of("ticks").ticks(),n=this.of("within").positive();return new ja(t,this.track(e,t),n)}decoded(e){try{return e()}catch(t){throw new Error(`${this.where}: ${t instanceof Error?t.message:"unreadable"}`)}}};function Kc(s,e){let t=s.of("box");if(!t.missing)return{kind:"box",size:t.numbers(3)};for(let i of["cylinder","capsule"]){let r=s.of(i);if(!r.missing)return{kind:i,radius:r.of("radius").number(),length:r.of("length").number()}}let n=s.of("sphere");return n.missing?{kind:"mesh",mesh:s.of("mesh").index(e)}:{kind:"sphere",radius:n.of("radius").number()}}function jc(s){let e=r=>{let o=s.of(r),a=o.decoded(()=>el(o.text()));if(a.length%12!==0)throw new Error(`a mesh's ${r} do not come in threes`);return a.slice().buffer},t=new Float32Array(e("vertices")),n=new Uint32Array(e("triangles")),i=t.length/3;for(let r of n)if(r>=i)throw new Error("a mesh's triangle names a vertex that is not there");for(let r of t)if(!Number.isFinite(r))throw new Error("a mesh's vertex is not a number");return{vertices:t,triangles:n}}var Od=s=>({full:s.of("full").maybe(e=>e.number()),zero:s.of("zero").maybe(e=>e.number())});function nv(s,e){let{width:t}=s.track,n=new Float64Array(t*e.length);return e.forEach((i,r)=>{s.at(i);for(let o=0;o<t;o++)n[r*t+o]=s.number(o)}),{width:t,count:e.length,values:n}}function Bd(s){let e=new ur(JSON.parse(s),""),t=e.of("format").text();if(t!=="kinemark-replay/2")throw new Error(`its format is ${t}, and this page shows kinemark-replay/2`);let n=e.of("stepS").positive();if(e.of("ticks").text()==="")throw new Error("it has no frame: the run ended before its first step");let i=e.of("ticks").ticks(),r=e.of("meshes").maybe(d=>d.list(jc))??[],o=e.of("tracks").list(d=>d.way(7)),a=e.of("nodes").list(d=>{let g=d.of("track").maybe(x=>x.index(o.length));return{name:d.of("name").text(),kind:d.of("kind").one(Qx,"fixed"),shapes:d.of("shapes").list(x=>({solid:Kc(x.of("solid"),r.length),pose:x.of("pose").pose()})),pose:g===null?d.of("pose").pose():null,parent:d.of("parent").maybe(x=>x.index(tv)),track:g??-1}});for(let d of a)if(d.parent!==null&&d.parent>=a.length)throw new Error(`${d.name} hangs on a node that is not there`);let l=d=>({name:d.of("name").text(),node:d.of("node").maybe(g=>g.index(a.length)),pose:d.of("pose").pose()}),c=e.of("joints").list(d=>({name:d.of("name").text(),unit:d.of("unit").text()})),h=e.of("tcp").way(3),u=e.of("q").list(d=>d.way(1));if(u.length!==c.length)throw new Error(`there are ${u.length} tracks of ${c.length} joints`);let f=(d,g)=>e.of(d).maybe(x=>x.list(g))??[];return{task:e.of("task").text(),title:e.of("title").text(),stepS:n,ticks:i,lab:l(e.of("lab")),nodes:a,meshes:r,frames:f("frames",l),moves:{tcp:h,q:u,nodes:o},tcp:nv(h,i),wanted:e.of("wanted").maybe(d=>d.track(3,i)),joints:c,other:e.of("other").maybe(d=>({tcp:d.of("tcp").track(3,i),q:d.of("q").list(g=>({name:g.of("name").text(),track:g.of("track").track(1,i)}))})),reference:e.of("reference").maybe(d=>({periodS:d.of("periodS").positive(),path:d.of("path").track(3,null)})),goals:f("goals",d=>({position:d.of("position").numbers(3),...Od(d)})),paths:f("paths",d=>({name:d.of("name").text(),points:d.of("points").list(g=>g.numbers(3)),...Od(d)})),contacts:f("contacts",d=>({from:d.of("from").number(),to:d.of("to").number(),first:d.of("first").text(),second:d.of("second").text(),point:d.of("point").numbers(3),impulse:d.of("impulse").number(),force:d.of("force").maybe(g=>g.number())??0,normal:d.of("normal").maybe(g=>g.numbers(3))})),events:f("events",d=>({tick:d.of("tick").number(),kind:d.of("kind").one(ev,"other"),text:d.of("text").text()})).sort((d,g)=>d.tick-g.tick),ghostLabel:e.of("ghostLabel").maybe(d=>d.text()),mainLabel:e.of("mainLabel").maybe(d=>d.text()),ended:e.of("ended").maybe(d=>d.text())}}var kd="kinemark-arm/1";function zd(s){let e=new ur(JSON.parse(s),""),t=e.of("format").text();if(t!==kd)throw new Error(`its format is ${t}, and this page shows ${kd}`);let n=e.of("meshes").list(jc),i=e.of("nodes").list(c=>({name:c.of("name").text(),shapes:c.of("shapes").list(h=>({solid:Kc(h.of("solid"),n.length),pose:h.of("pose").pose()}))})),r=e.of("q").list(c=>({name:c.of("name").text(),unit:c.of("unit").text(),lower:c.of("lower").maybe(h=>h.number()),upper:c.of("upper").maybe(h=>h.number())})),o=new Set([0]),a=e.of("joints").list(c=>{let h={parent:c.of("parent").index(i.length),child:c.of("child").index(i.length),pose:c.of("pose").pose(),axis:c.of("axis").numbers(3),turns:c.of("turns").yes(),q:c.of("q").maybe(u=>u.index(r.length)),gear:c.of("gear").number(),offset:c.of("offset").number()};if(!o.has(h.parent)||o.has(h.child))throw new Error(`${i[h.child].name} hangs on nothing`);return o.add(h.child),h});if(o.size!==i.length)throw new Error("a link has no joint");let l=c=>({node:c.of("node").index(i.length),pose:c.of("pose").pose()});return{name:e.of("name").text(),chain:{count:i.length,joints:a,q:r,tcp:l(e.of("tcp")),lab:l(e.of("lab"))},nodes:i,meshes:n,labName:e.of("lab").of("name").text(),branches:e.of("branches").yes(),jacobian:e.of("jacobian").yes()}}var Vd=/[\s.,;:!?)\]}>'"\u2019\u201d\u00bb\u2026]+$/,iv=/^-?(?:\d+(?:[.,]\d*)?|[.,]\d+)$/;function Gd(s){try{return decodeURIComponent(s)}catch{return s}}function nl(s){let e=new Map;for(let r of s.replace(/^#/,"").split("&")){let[o,...a]=r.split("=");e.set(o,Gd(a.join("=")))}let t=e.get("task");if(!t)return null;let n=(e.get("t")??"").trim(),i=n.replace(Vd,"");return i===""?{task:t,t:null,unread:n===""?null:n}:iv.test(i)?{task:t,t:Number(i.replace(",",".")),unread:null}:{task:t,t:null,unread:n}}function Hd(s,e){return e.find(t=>t===s)??e.find(t=>t===s.replace(Vd,""))}function Wd(s,e){return`#task=${encodeURIComponent(s)}&t=${e}`}var sv=400,tl=class{timer=0;next="";write(e){this.next=e,!this.timer&&(this.timer=window.setTimeout(()=>this.flush(),sv))}forget(){clearTimeout(this.timer),this.timer=0}flush(){if(this.timer){this.forget();try{history.replaceState(history.state,"",this.next)}catch{}}}};function Xd(s,e){let t=s.href.replace(/#.*$/,"");return(s.protocol==="file:"?Gd(t.replace(/^.*\//,"")):t)+e}async function qd(s){try{return await navigator.clipboard.writeText(s),!0}catch{let e=document.createElement("textarea");e.value=s,e.setAttribute("readonly",""),e.style.position="fixed",e.style.opacity="0";let t=document.activeElement;document.body.append(e),e.select();let n=!1;try{n=document.execCommand("copy")}catch{n=!1}return e.remove(),t instanceof HTMLElement&&t.focus({preventScroll:!0}),n}}var il=class{words=Z("p");region=Z("div",{class:"replay-notice",role:"status"});box=Z("div");constructor(){let e=Z("button",{type:"button"},"Close");e.addEventListener("click",()=>this.clear()),this.box.append(this.words,e),document.body.append(this.region)}say(e){this.words.textContent=e,this.region.replaceChildren(this.box)}clear(){this.region.replaceChildren()}};var sl=class{element=Z("div",{class:"unseen","aria-live":"polite",role:"status"});timer=0;say(e){this.after(()=>e,60)}soon(e){this.after(e,400)}after(e,t){clearTimeout(this.timer),this.element.textContent="",this.timer=window.setTimeout(()=>{this.element.textContent=e()},t)}};function ut(s,e,t,n){let i=e===null||n===null,r=Z("button",{type:"button",class:i?"replay-word":"replay-sign"});return i?r.append(s):(r.setAttribute("aria-label",s),r.title=n?`${s} (${n})`:s),e&&r.append(vh(e)),r.addEventListener("click",t),r}function hs(s,...e){return Z("div",{role:"group","aria-label":s,class:"replay-group"},...e)}var ol=[.1,.25,.5,1,2,4],rv=3,rl=class{constructor(e){this.replay=e;let{ticks:t,stepS:n}=e;this.start=t[0]*n,this.end=t[t.length-1]*n,this.t=this.start,document.addEventListener("visibilitychange",()=>this.last=0)}replay;t;start;end;playing=!1;speed=1;loop=!1;frameTimes=new Pr;listeners={moved:[],rested:[],ended:[],changed:[]};last=0;kept=null;on(e,t){this.listeners[e].push(t)}notify(e){for(let t of this.listeners[e])t()}get tick(){return Math.round(this.t/this.replay.stepS)}timeOf(e){let t=Math.round(1/this.replay.stepS);return Math.abs(t*this.replay.stepS-1)<1e-9?e/t:e*this.replay.stepS}put(e){this.t=Math.min(this.end,Math.max(this.start,e)),this.notify("moved")}nearest(e){let t=Math.min(this.end,Math.max(this.start,e));return this.timeOf(Math.round(t/this.replay.stepS))}seek(e){Number.isNaN(e)||(this.kept=null,this.stop(),this.put(this.nearest(e)),this.notify("rested"))}peek(e){this.playing||Number.isNaN(e)||(this.kept??=this.t,this.put(this.nearest(e)))}back(){if(this.kept===null)return;let e=this.kept;this.kept=null,this.put(e)}stay(){this.kept!==null&&this.seek(this.t)}get rest(){return this.kept??this.t}seekTick(e){this.seek(this.timeOf(e))}step(e){this.seek(this.stepped(e))}stepped(e){let t=this.replay.ticks,n=this.tick,i=0,r=t.length;for(;i<r;){let a=i+r>>1;t[a]<n?i=a+1:r=a}let o=i<t.length&&t[i]===n||e<0?i:i-1;return this.timeOf(t[Math.min(t.length-1,Math.max(0,o+e))])}event(e){let{events:t}=this.replay,n=this.tick;if(e>0)return t.find(i=>i.tick>n);for(let i=t.length-1;i>=0;i--)if(t[i].tick<n)return t[i]}now(){let e=this.tick;return this.replay.events.filter(t=>t.tick===e)}get moves(){return this.end>this.start}play(){this.playing||!this.moves||(this.back(),this.t>=this.end&&this.put(this.start),this.playing=!0,this.last=0,Dh(this.advance,this.frameTimes),this.notify("changed"))}stop(){this.playing&&(this.playing=!1,Fh(this.advance),this.notify("changed"))}pause(){this.playing&&this.seek(this.t)}toggle(){this.playing?this.pause():this.play()}setSpeed(e){this.speed=e,this.notify("changed")}setLoop(e){this.loop=e,this.notify("changed")}advance=e=>{let t=this.last===0?0:(e-this.last)/1e3,n=t>rv?0:t;this.last=e;let i=this.t+n*this.speed;i<this.end?this.put(i):this.loop?this.put(this.start+(i-this.end)%(this.end-this.start)):(this.t=this.end,this.pause(),this.notify("ended"))}};var Yd=[{sign:"left",turn:[-1,0],name:"left"},{sign:"right",turn:[1,0],name:"right"},{sign:"up",turn:[0,1],name:"up"},{sign:"down",turn:[0,-1],name:"down"}],$d=Math.PI/12,Zd=.1,al=class{constructor(e,t){this.actions=t;let n=(h,u)=>{let f=ut(h,null,()=>this.show(u,!t.shown(u)));return f.setAttribute("aria-pressed",String(t.shown(u))),this.toggles.set(u,f),f},i=n("Shadows","shadows"),r=hs("Show",n("Frames","frames"),n("Velocity","velocity"),i);e.nodes.some(h=>h.kind==="ghost")&&r.append(n(dr(e)?"Reference arm":`Run ${e.ghostLabel}`,"ghost"));let o=ut("2D",null,()=>this.flatten(!this.isFlat));o.setAttribute("aria-pressed","false");let a=(h,u)=>ut(h,null,()=>{this.flatten(!1),t.view().camera?.view(u),this.tell()}),l=hs("Look from",a("Fit","fit"),a("Side","side"),a("Top","top"),...t.flatten?[o]:[]);this.plane=o,this.follow=ut("Follow the TCP",null,()=>{let h=t.view().camera;h?.follow(!h.following),this.tell()}),this.follow.setAttribute("aria-pressed","false");let c=this.camera();c.append(this.follow),this.spatial.push(i,c),this.cameraOnly.push(l,i,c),this.panel.append(l,r,c),this.panel.hidden=!0,this.opener.setAttribute("aria-expanded","false"),this.element=Z("div",{class:"replay-group replay-view"},this.opener,this.panel),this.element.addEventListener("keydown",h=>{h.key!=="Escape"||this.panel.hidden||(h.stopPropagation(),this.open(!1),this.opener.focus())}),document.addEventListener("pointerdown",h=>{let u=h.target instanceof Element?h.target:null;!this.element.contains(u)&&!u?.closest(".replay-stage")&&this.open(!1)})}actions;element;opener=ut("View","down",()=>this.open(!!this.panel.hidden),null);panel=Z("div",{class:"replay-menu",role:"group","aria-label":"View"});cameraOnly=[];spatial=[];plane;follow;isFlat=!1;toggles=new Map;flatten(e){if(!(!this.actions.flatten||e===this.isFlat)){this.isFlat=e,this.actions.flatten(e),this.plane.setAttribute("aria-pressed",String(e));for(let t of this.spatial)t.hidden=e}}tell(){this.follow.setAttribute("aria-pressed",String(this.actions.view().camera?.following??!1))}open(e){this.panel.hidden=!e,this.opener.setAttribute("aria-expanded",String(e))}camera(){let e=()=>this.actions.view().camera,t=Yd.map(({sign:o,turn:[a,l]})=>ut("",o,()=>e()?.panning?e()?.shift(Zd*a,Zd*l):e()?.turn($d*a,$d*l))),n=ut("Move",null,()=>{let o=e();o&&(o.panning=!o.panning,i(o.panning))});n.title="Whether the arrows, and a drag, move the view rather than turn it";let i=o=>{n.setAttribute("aria-pressed",String(o)),t.forEach((a,l)=>{a.title=`${o?"Move":"Turn"} ${Yd[l].name}`,a.setAttribute("aria-label",a.title)})};i(!1);let r=(o,a,l,c)=>ut(o,a,()=>e()?.zoom(l),c);return hs("Camera",...t,n,r("Farther","farther",1.25,"\u2212 in the 3D view, or Ctrl and the wheel"),r("Closer","closer",.8,"+ in the 3D view, or Ctrl and the wheel"))}show(e,t){this.actions.show(e,t),this.toggles.get(e)?.setAttribute("aria-pressed",String(t))}flat(e){for(let t of this.cameraOnly)t.hidden=e}};var ll=class{element;menu;full;constructor(e,t,n){let i=ut("Play","play",()=>t.toggle(),"space");i.classList.add("replay-play");let r=ut("Loop","loop",()=>t.setLoop(!t.loop),"L"),o=hs("Playback");e.events.length>0&&o.append(ut("Previous event","previous",()=>n.event(-1),"[")),o.append(ut("One frame back","back",()=>t.step(-1),"left arrow"),i,ut("One frame on","on",()=>t.step(1),"right arrow")),e.events.length>0&&o.append(ut("Next event","next",()=>n.event(1),"]")),o.append(r);let a=Z("select",{"aria-label":"Speed"});for(let h of ol){let u=Z("option",{value:String(h)},`${h}\xD7`);u.selected=h===1,a.append(u)}a.addEventListener("change",()=>t.setSpeed(Number(a.value))),o.append(a),this.menu=new al(e,n),this.full=n.fullScreen&&ut("Full screen","full",n.fullScreen);let l=ut("Copy link","link",()=>n.copyLink(),null);if(t.on("changed",()=>{_l(i,t.playing?"pause":"play"),i.setAttribute("aria-label",t.playing?"Pause":"Play"),i.title=t.playing?"Pause (space)":"Play (space)",r.setAttribute("aria-pressed",String(t.loop)),a.value=String(t.speed)}),r.setAttribute("aria-pressed","false"),!t.moves)for(let h of o.querySelectorAll("button, select"))h.disabled=!0;let c=Z("div",{class:"replay-group"},this.menu.element,...this.full?[this.full]:[],l);this.element=Z("div",{class:"replay-controls"},o,c)}show(e,t){this.menu.show(e,t)}flat(e){this.menu.flat(e)}filled(e){this.full&&(this.full.title=e?"Leave full screen (Escape)":"Full screen",this.full.setAttribute("aria-label",this.full.title),_l(this.full,e?"window":"full"))}};function Jd(){let s=new Map;for(let e of document.querySelectorAll("[data-task]")){let t=e.closest("section")??e,n=e.dataset.task??"";n!==""&&t instanceof HTMLElement&&!s.has(n)&&s.set(n,t)}return s}function us(s,e){for(let r=s.parentElement;r;r=r.parentElement)r instanceof HTMLDetailsElement&&(r.open=!0);s.tabIndex<0&&!s.hasAttribute("tabindex")&&(s.tabIndex=-1);let{top:t,bottom:n}=s.getBoundingClientRect();s.offsetHeight>0&&t>=0&&n<=innerHeight||s.scrollIntoView({block:s.offsetHeight<innerHeight?"center":"start",behavior:e||Ha()?"auto":"smooth"}),s.focus({preventScroll:!0})}function Kd(s,e){let t=Z("div",{class:"replay-corner"}),n=Z("div",{class:"replay-frame"},e,t),i=s.closest("section");if(!i)return n;let r=!1,o=!1,a=!0,l=()=>{s.classList.toggle("small",r&&o&&a)};return t.append(ut("Back to the replay","up",()=>us(s,!1)),ut("Hide the small picture","close",()=>{a=!1,l()})),new IntersectionObserver(c=>{let{isIntersecting:h,boundingClientRect:u}=c[c.length-1];r=!h&&u.height>0,l()},{rootMargin:"0px 0px 10000000px 0px"}).observe(n),new IntersectionObserver(c=>{o=c[c.length-1].isIntersecting,l()},{rootMargin:"0px 0px -50% 0px"}).observe(i),n}function jd(s){if(!s.parentElement?.matches("section.task")||!s.nextElementSibling)return;let t=Z("div",{class:"replay-pane"});for(;s.nextSibling;)t.append(s.nextSibling);let n=Z("div",{class:"replay-panes"});s.before(n),n.append(s,t)}var ov="button, select, a, summary, input:not([type=range]), textarea",av=[" ","l","L"];function cl(s,e,t){s.addEventListener("keydown",n=>{if(!(!(n.ctrlKey||n.metaKey||n.altKey)||n.getModifierState("AltGraph"))||n.defaultPrevented)return;let r=n.target instanceof Element?n.target:s,o=n.shiftKey?10:1,a={ArrowLeft:()=>e.step(-o),ArrowRight:()=>e.step(o),Home:()=>e.seek(e.start),End:()=>e.seek(e.end),"[":()=>t(-1),"]":()=>t(1),l:()=>e.setLoop(!e.loop),L:()=>e.setLoop(!e.loop)};if(r.matches("input[type=range]")&&(a.ArrowDown=a.ArrowLeft,a.ArrowUp=a.ArrowRight,a.PageDown=()=>e.step(-10),a.PageUp=()=>e.step(10)),r.matches(ov)||(a[" "]=()=>e.toggle()),r.matches("select"))return;let l=a[n.key];l&&(n.preventDefault(),!(n.repeat&&av.includes(n.key))&&l())})}var lv=[.5,-.5,.3,-.3].flatMap(s=>[{turn:s,elevation:.36},{turn:s,elevation:.28}]),cv=[-.5,.5].map(s=>({turn:s,elevation:.65})),hv=12;function uv(s,{turn:e,elevation:t}){let n=(s.side===0?0:-Math.PI/2)+(s.flipped?Math.PI:0)+e,[i,r,o,a]=[Math.cos(n),Math.sin(n),Math.cos(t),Math.sin(t)];return{right:[-r,i,0],up:[-a*i,-a*r,o],back:[o*i,o*r,a]}}var ds=(s,e)=>s[0]*e[0]+s[1]*e[1]+s[2]*e[2];function dv(s,e,t){return s.length>2&&s.every(([n,i],r)=>{let[o,a]=s[(r+1)%s.length];return(o-n)*(t-i)-(a-i)*(e-n)>0})}function fv(s,e,t){let n=0;for(let i of t){let r=Lr(i.map(a=>[ds(s.right,a),ds(s.up,a)])),o=i.reduce((a,l)=>a+ds(s.back,l),0)/i.length;for(let a of e)ds(s.back,a)<o&&dv(r,ds(s.right,a),ds(s.up,a))&&n++}return n}function Qd(s,e,t){let{nodes:n,ticks:i,stepS:r,events:o,meshes:a}=s,l=[...new Set([...o.map(({tick:x})=>x),i[i.length-1]])],c=Math.ceil(l.length/hv),h=[];for(let x of l.reverse().filter((p,m)=>m%c===0))e.at(x*r),h.push([...e.tcpInWorld]),n.forEach((p,m)=>p.kind==="free"&&h.push([...e.poses.subarray(7*m,7*m+3)]));e.at(i[0]*r);let u=(x,p)=>{let m=[],b=new Float64Array(3);for(let T=0;T<x.length;T+=4)it(b,0,e.poses,7*p,x[T],x[T+1],x[T+2]),m.push([...b]);return m},f=n.flatMap((x,p)=>x.kind==="fixed"&&x.track<0?x.shapes.map(m=>u(Ti(m,a),p)):[]),d=t.side===2?cv:lv,g=d.map(x=>fv(uv(t,x),h,f));return d[g.indexOf(Math.min(...g))]}function ef(s,e,t){let n=[],i=o=>t?e-o:o-e;for(let{x:o,y:a}of s)for(let l=0;l+1<o.length;l++){let[c,h]=[i(a[l]),i(a[l+1])];if(c<=1&&h<=1)continue;let u=o[l]+(c===h?0:c/(c-h))*(o[l+1]-o[l]),f=[c>0?o[l]:u,h>0?o[l+1]:u];n.push([Math.min(...f),Math.max(...f)])}n.sort((o,a)=>o[0]-a[0]);let r=[];for(let[o,a]of n){let l=r[r.length-1];l&&o<=l[1]+6?l[1]=Math.max(l[1],a):r.push([o,a])}return r.slice(0,200)}function fr(s,e,t=null){if(!/^m[-\d m]*z?$/.test(s))return[];let n=0,i=0;return s.slice(1).split("m").map(r=>{let o=r.match(/-?\d+/g)??[],a=o.length>>1,l=new Float64Array(a),c=new Float64Array(a);for(let h=0;h<a;h++)l[h]=n+=Number(o[2*h]),c[h]=i+=Number(o[2*h+1]);return{x:l,y:c,band:e,dashes:t}})}function tf({x:s,y:e}){let t=new Map;s.forEach((r,o)=>{let a=t.get(r);a?(a[0]=Math.min(a[0],e[o]),a[1]=Math.max(a[1],e[o])):t.set(r,[e[o],e[o]])});let n=[0,0],i=[...t].sort((r,o)=>r[0]-o[0]).map(([r,[o,a]])=>{let l=[r,Math.round(.5*(o+a))],c=`${l[0]-n[0]} ${l[1]-n[1]}`;return n=l,c});return i.length?`m${i.join(" ")}`:""}function nf(s){let e=new Map;for(let t of s.querySelectorAll("path")){let n=t.getAttribute("stroke"),i=(n??t.getAttribute("fill")??"").toUpperCase(),r=fr(t.getAttribute("d")??"",n===null,t.getAttribute("stroke-dasharray")),o=e.get(i);o?o.push(...r):e.set(i,r)}return e}function sf(s,e,t){return(s?.get(e.toUpperCase())??[]).filter(i=>i.band||i.dashes===t)}function Qc(s,e,t){let[n,i,r,o]=e;return s.filter(({x:a,y:l})=>{let c=0;for(let h=0;h<a.length;h++)a[h]>=n-t&&a[h]<=r+t&&l[h]>=i-t&&l[h]<=o+t&&c++;return 2*c>a.length})}function rf(s,e,t){let n=1/0,i=-1/0,r=e-.5,o=e+.5;for(let{x:a,y:l,band:c}of s){let h=a.length,u=1/0,f=-1/0,d=g=>{u=Math.min(u,g),f=Math.max(f,g)};for(let g=0;g<h;g++){let x=g+1<h?g+1:c||h===1?0:-1;if(x<0)break;let[p,m]=a[g]<=a[x]?[g,x]:[x,g];if(a[m]<r||a[p]>o)continue;let b=a[m]>a[p]?(l[m]-l[p])/(a[m]-a[p]):0;d(a[m]>a[p]?l[p]+b*(Math.max(r,a[p])-a[p]):l[p]),d(a[m]>a[p]?l[p]+b*(Math.min(o,a[m])-a[p]):l[m])}u>f||(n=Math.min(n,c?u+t:u),i=Math.max(i,c?f-t:f))}return i>=n?[n,i]:null}var pv=10;function eh(s,e){let t=(s.foot-e)/(s.foot-s.top);return s.log?s.low*(s.high/s.low)**t:s.low+t*(s.high-s.low)}function mv(s,e){let t=Math.floor(-Math.log10(Math.max(2*e,1e-12))+1e-9);if(t>=0)return Mt(s,Math.min(9,t));let n=10**Math.min(300,-t);return String(Math.round(s/n)*n||0)}function th(s,e,t,n){let i=eh(s,e),r=Math.max(Math.abs(eh(s,e-t)-i),Math.abs(eh(s,e+t)-i));if(n!==void 0&&Math.abs(i)>=n-r){let o=String(Number(n.toPrecision(4)));return i>0?`at least ${o}`:`at most -${o}`}return s.log&&e>=s.foot-t?`at most ${Number(s.low.toPrecision(2))}`:mv(i,r)}function of(s,[e,t],{off:n,cut:i}){let r=.5*(t-e);if(2*r<=pv)return th(s,e+r,n+r,i);let[o,a]=[th(s,t,n,i),th(s,e,n,i)];return o===a?o:`${o} \u2026 ${a}`}var af=260,gv=200,lf=20,yv=[1,2,5],xv=4,vv=0;function _v(s,e){let t=1;for(let r=3;r>=-6;r--){let o=yv.slice().reverse().map(a=>a*10**r).find(a=>(e-s)/a>=xv);if(o!==void 0){t=o;break}}let n=Math.max(0,Math.ceil(-Math.log10(t)-1e-9)),i=[];for(let r=Math.ceil(s/t-1e-9);r*t<=e+1e-9*t;r++)i.push({t:r*t,text:(r*t).toFixed(n)});return i}var Wt=(s,e)=>Number(s.getAttribute(e)),hl=class{constructor(e,t,n){this.box=t;this.t=n;let[i,r,o,a]=t;this.clip=`stretch-${++vv}`;let l=Ae("rect",{x:String(i),y:String(r),width:String(o-i),height:String(a-r)}),c=[...e.children].filter(u=>u instanceof SVGElement&&!u.classList.contains("replay-overlay")),h=(u,f)=>this.within(u,f);for(let u of c)if(u.tagName==="path")this.take(u);else if(u.tagName==="rect"&&h(Wt(u,"x"),Wt(u,"y"))&&Wt(u,"width")<o-i-1)this.areas.push({rect:u,x:Wt(u,"x"),width:Wt(u,"width")});else if(u.tagName==="text"){let[f,d]=[Wt(u,"x"),Wt(u,"y")];f>=i-1&&f<=o+1&&d>a&&d<a+gv&&Number.isFinite(Number(u.textContent?.replace("\u2212","-")))&&this.numbers.push(u)}for(let u of this.marks){let f=Wt(u.parts[0],"data-at");for(let d of c){let[g,x]=d.tagName==="circle"?[Wt(d,"cx"),Wt(d,"cy")]:[Wt(d,"x"),Wt(d,"y")];["circle","text"].includes(d.tagName)&&Math.abs(g-f)<2&&x<r&&x>r-af&&u.parts.push(d)}}e.append(Ae("clipPath",{id:this.clip},l)),this.lines[0]?.path.before(this.grid),e.append(this.fresh)}box;t;lines=[];areas=[];marks=[];numbers=[];fresh=Ae("g",{class:"replay-numbers"});grid=Ae("path",{class:"replay-grid",fill:"none"});clip;within(e,t){let[n,i,r,o]=this.box;return e>=n-1&&e<=r+1&&t>=i-lf&&t<=o+lf}take(e){let[t,n,i,r]=this.box,o=e.getAttribute("d")??"",a=fr(o,!1),l=a.flatMap(({x:h,y:u})=>[...h].map((f,d)=>[f,u[d]]));if(l.length===0)return;let c=l[l.length-1];if(l.length===2&&l[0][1]<n-1&&l[0][1]>n-af&&Math.abs(c[1]-n)<2)e.setAttribute("data-at",String(l[0][0])),this.marks.push({x:c[0],parts:[e]});else if(l.every(([h,u])=>this.within(h,u))){let h=([f,d])=>Math.min(Math.abs(f-t),Math.abs(f-i))<2&&Math.min(Math.abs(d-n),Math.abs(d-r))<2;a.length===1&&l.length>=4&&l.every(h)||this.lines.push({path:e,d:o,parts:a,closed:e.getAttribute("fill")!=="none"})}}add(e){for(let t of e)this.areas.push({rect:t,x:Wt(t,"x"),width:Wt(t,"width")})}show(e){let[t,,n]=this.box,[i,r]=this.t,o=n-t,[a,l]=e??[i,r],c=t+(a-i)/(r-i)*o,h=(r-i)/(l-a),u=d=>t+(d-c)*h,f=d=>d>=t-1&&d<=n+1;for(let{path:d,d:g,parts:x,closed:p}of this.lines)d.setAttribute("d",e?bv(x,p,u,t-o,n+o):g),e?d.setAttribute("clip-path",`url(#${this.clip})`):d.removeAttribute("clip-path");for(let{rect:d,x:g,width:x}of this.areas){let p=Math.min(n,Math.max(t,u(g))),m=Math.min(n,Math.max(t,u(g+x)));d.setAttribute("x",p.toFixed(0)),d.setAttribute("width",Math.max(0,m-p).toFixed(0))}for(let{x:d,parts:g}of this.marks){let x=u(d);for(let p of g)e?p.setAttribute("transform",`translate(${(x-d).toFixed(0)} 0)`):p.removeAttribute("transform"),p.style.display=f(x)?"":"none"}this.write(e,a,l)}write(e,t,n){let[i,r,o,a]=this.box;for(let c of this.numbers)c.style.display=e?"none":"";if(this.fresh.replaceChildren(),this.grid.setAttribute("d",""),!e)return;let l=_v(t,n).map(({t:c,text:h})=>({x:Math.round(i+(c-t)/(n-t)*(o-i)),text:h}));this.grid.setAttribute("d",l.map(({x:c})=>`M${c} ${r}V${a}`).join(""));for(let{x:c,text:h}of this.numbers.length?l:[]){let u=this.numbers[0].cloneNode();u.style.display="",u.setAttribute("x",String(c)),u.textContent=h,this.fresh.append(u)}}};function bv(s,e,t,n,i){let r="";for(let{x:o,y:a}of s){let l=[...o].map(t),c=!1;for(let h=0;h<l.length;h++){let u=e||Math.max(l[h],l[h+1]??l[h],l[h-1]??l[h])>=n&&Math.min(l[h],l[h+1]??l[h],l[h-1]??l[h])<=i;u&&(r+=`${c?"L":"M"}${(e?Math.min(i,Math.max(n,l[h])):l[h]).toFixed(1)} ${a[h]}`),c=u}e&&l.length&&(r+="z")}return r}var ul=class{constructor(e,t,n){this.start=e;this.end=t;this.stepS=n}start;end;stepS;shown=null;listeners=[];on(e){this.listeners.push(e)}put(e){this.shown=e;for(let t of this.listeners)t()}show(e,t){let n=this.end-this.start,i=Math.max(20*this.stepS,Math.abs(t-e));if(i>=n)return this.reset();let r=.5*(e+t),o=Math.min(this.end-i,Math.max(this.start,r-.5*i));this.put([o,o+i])}zoom(e,t){let[n,i]=this.shown??[this.start,this.end],r=Math.min(i,Math.max(n,t));this.show(r-e*(r-n),r+e*(i-r))}hold(e){if(!this.shown)return;let[t,n]=this.shown,i=.1*(n-t);e<t?this.show(e-i,e-i+(n-t)):e>n&&this.show(e+i-(n-t),e+i)}reset(){this.shown&&this.put(null)}};var cf=12,dl=12,Mv=6,nh=1.6,pr=70,Sv=0,fs=(s,e)=>Array.isArray(s)&&s.length===e&&s.every(t=>typeof t=="number"&&Number.isFinite(t));function wv(s){let e=JSON.parse(s);return Array.isArray(e)?e.filter(t=>!t||!fs(t.box,4)?!1:t.kind==="time"?fs(t.t,2)&&t.t[1]>t.t[0]&&fs(t.y,2)&&t.y[1]!==t.y[0]&&(!t.log||t.y[0]>0&&t.y[1]>0)&&Array.isArray(t.series):t.kind==="plane"&&fs(t.axes,2)&&fs(t.signs,2)&&fs(t.zero,2)&&typeof t.pixelsPerM=="number"):[]}var ih=class{constructor(e,t,n,i,r,o,a){this.figure=e;this.svg=t;this.cursor=n;this.world=i;this.stepS=r;this.window=o;this.acts=a;let l=Ae("g",{class:"replay-overlay","aria-hidden":"true"});for(let c of wv(e.dataset.panels??"[]")){let[,h,,u]=c.box,f=c.kind==="time"?Ae("line",{class:"replay-cursor",x1:"0",x2:"0",y1:String(h),y2:String(u)}):Ae("circle",{class:"replay-dot",r:String(.5*this.unit())});l.append(f),this.hands.push({panel:c,mark:f,x:NaN,y:NaN})}if(this.hands.length!==0){if(t.append(l),e.classList.add("replay-plot"),this.box.hidden=!0,e.append(this.box),this.hands.some(c=>c.panel.kind==="time")){let c=Ae("line",{class:"replay-hover"});c.style.visibility="hidden",this.picked.style.visibility="hidden",l.append(this.picked,c),this.hover=c,this.reset.classList.add("replay-reset"),this.reset.hidden=!0,e.append(this.reset),o.on(()=>this.stretch()),t.addEventListener("pointermove",h=>this.point(h)),t.addEventListener("pointerdown",h=>this.press(h)),t.addEventListener("pointerup",h=>this.release(h)),t.addEventListener("dblclick",h=>{o.reset(),this.point(h)}),t.addEventListener("wheel",h=>this.wheel(h),{passive:!1}),e.addEventListener("pointerleave",()=>this.leave()),t.addEventListener("pointercancel",()=>{this.drag=null,this.leave()}),t.addEventListener("click",h=>this.click(h)),this.byKeys()}this.follow(),this.timePanels().some(({full:c,zero:h})=>c!==void 0&&h!==void 0)&&this.read()}}figure;svg;cursor;world;stepS;window;acts;hands=[];paths=null;curves=new Map;held=!1;box=Z("div",{class:"replay-values","aria-hidden":"true"});hover=null;stretched=[];drag=null;picked=Ae("rect",{class:"replay-picked"});reset=ut("Whole run",null,()=>{this.window.reset(),this.figure.focus({preventScroll:!0})});byKeys(){let{figure:e,cursor:t}=this;e.tabIndex=0,e.setAttribute("aria-description","Arrow keys show other moments of the run and read out their values. Enter stays there; Escape, or leaving, goes back. Plus and minus zoom the time, 0 shows the whole run.");let n=r=>{t.pause(),t.peek(r),this.window.hold(t.t)};e.addEventListener("keydown",r=>this.zoomKey(r)),cl(e,{start:t.start,end:t.end,get loop(){return t.loop},step:r=>n(t.stepped(r)),seek:n,toggle:()=>t.toggle(),setLoop:r=>t.setLoop(r)},this.acts.event);let i=t.t;e.addEventListener("keydown",r=>{r.key==="Escape"||r.key==="Tab"||(r.key==="Enter"&&r.target===e&&t.stay(),this.stay(),t.t!==i&&!t.playing&&this.acts.say(this.said()),i=t.t)}),e.addEventListener("focus",()=>e.matches(":focus-visible")&&this.stay()),e.addEventListener("blur",()=>this.leave())}stay(){this.held=!0,this.beside()}timePanels(){return this.hands.map(e=>e.panel).filter(e=>e.kind==="time")}get isJudged(){return this.timePanels().some(({full:e})=>e!==void 0)}beside(){let e=this.timePanels();if(e.length===0)return;this.hover&&(this.hover.style.visibility="hidden"),this.write(this.cursor.t,e.flatMap(i=>this.rows(i,this.cursor.t)),e.length===1?e[0].name:void 0);let{top:t,bottom:n}=this.figure.getBoundingClientRect();this.place(this.seen(e[0],this.cursor.t),.5*(Math.max(0,t)+Math.min(innerHeight,n)))}said(){let{t:e}=this.cursor,t=this.timePanels(),n=t.map(i=>{let r=this.rows(i,e).map(({series:o,text:a})=>`${o.name} ${a}`);return t.length>1&&i.name?`${i.name}: ${r.join(", ")}`:r.join(", ")});return[Zn(e,this.stepS),...n].join("; ")}read(){if(!this.paths){this.paths=nf(this.svg);for(let e of this.timePanels()){let t=this.shade(e),n=new hl(this.svg,e.box,e.t);n.add(t),this.stretched.push({panel:e,drawn:n}),this.thin(e,n)}this.window.shown&&this.stretch()}}curve(e,t){let n=this.curves.get(t);return n||this.curves.set(t,n=Qc(sf(this.paths,t.colour,t.dashes??null),e.box,this.unit())),n}shade(e){let{full:t,zero:n,series:i,box:[r,o,a,l]}=e;if(t===void 0||n===void 0||t===n||i.length===0)return[];let c=e.log?Math.log(t/e.y[0])/Math.log(e.y[1]/e.y[0]):(t-e.y[0])/(e.y[1]-e.y[0]);if(!Number.isFinite(c))return[];let h=Math.min(l,Math.max(o,l-c*(l-o))),u=`hatch-${++Sv}`,d=ef(this.curve(e,i[0]),h,n>t).map(([p,m])=>{let[b,T]=[Math.max(r,p),Math.min(a,m)];return Ae("rect",{class:"replay-costly",x:b.toFixed(0),y:String(o),width:Math.max(10,T-b).toFixed(0),height:String(l-o),fill:`url(#${u})`})});if(d.length===0)return[];let g=()=>Ae("pattern",{id:u,width:String(pr),height:String(pr),patternUnits:"userSpaceOnUse",patternTransform:"rotate(45)",class:"replay-hatch"},Ae("rect",{width:String(pr),height:String(pr)}),Ae("line",{x1:"0",x2:"0",y1:"0",y2:String(pr)}));this.svg.querySelector("path")?.before(g(),...d);let x=Ae("svg",{class:"replay-swatch",viewBox:"0 0 280 160",width:"28",height:"16","aria-hidden":"true"},Ae("rect",{width:"280",height:"160",class:"replay-costly",fill:`url(#${u})`}));return this.figure.querySelector(".replay-costs")||this.figure.append(Z("p",{class:"replay-costs"},x,"hatched: beyond what earns all points")),d}thin(e,t){for(let n of this.svg.querySelectorAll("path[opacity]")){let i=e.series.find(({colour:a})=>a.toUpperCase()===n.getAttribute("fill")?.toUpperCase()),r=i?Qc(fr(n.getAttribute("d")??"",!0),e.box,this.unit()):[];if(!i||r.length===0)continue;n.classList.add("replay-band");let o=Ae("path",{class:"replay-middle",fill:"none",stroke:i.colour,d:r.map(a=>tf(a)).join("")});n.after(o),t.take(o)}}stretch(){this.read();let{shown:e}=this.window;for(let{drawn:t}of this.stretched)t.show(e);this.reset.hidden=e===null;for(let t of this.hands)t.x=NaN;this.follow()}range(e){return this.window.shown??e.t}zoomKey(e){if(e.target!==this.figure||e.ctrlKey||e.metaKey||e.altKey)return;let{window:t,cursor:n}=this,r={"+":()=>t.zoom(1/nh,n.t),"=":()=>t.zoom(1/nh,n.t),"-":()=>t.zoom(nh,n.t),0:()=>t.reset(),...t.shown?{Home:()=>t.reset()}:{}}[e.key];r&&(e.preventDefault(),r())}wheel(e){if(!e.ctrlKey&&!e.metaKey&&document.activeElement!==this.figure)return;let t=this.under(e);if(!t)return;e.preventDefault();let n=e.deltaMode===1?16:1;this.window.zoom(Math.exp(Math.min(.5,Math.max(-.5,.002*n*e.deltaY))),this.time(t.panel,t.x)),this.point(e)}press(e){let t=this.under(e);t&&e.button===0&&(this.drag={panel:t.panel,x:t.x,clientX:e.clientX,moved:!1}),this.point(e)}pick(e){let{drag:t,picked:n}=this;if(!t||(e.buttons&1)===0)return;let i=this.under(e);if(Math.abs(e.clientX-t.clientX)<Mv||i?.panel!==t.panel)return;t.moved=!0;let[,r,,o]=t.panel.box;for(let[a,l]of[["x",Math.min(t.x,i.x)],["width",Math.abs(i.x-t.x)],["y",r],["height",o-r]])n.setAttribute(a,l.toFixed(0));n.style.visibility="visible"}release(e){let{drag:t,picked:n}=this;if(n.style.visibility="hidden",!t?.moved)return;let i=Number(n.getAttribute("x")),r=[i,i+Number(n.getAttribute("width"))].map(o=>this.time(t.panel,o));this.window.show(r[0],r[1]),this.point(e)}unit(){let e=Number(this.svg.getAttribute("width"))||640;return 10*(this.svg.viewBox.baseVal.width||e)/e}follow(){this.held&&this.beside();for(let e=0;e<this.hands.length;e++){let t=this.hands[e],n=t.panel,i,r=0;if(n.kind==="time"){let[o,a]=this.range(n),l=.001*(a-o);t.mark.style.visibility=this.cursor.t<o-l||this.cursor.t>a+l?"hidden":"",i=this.seen(n,this.cursor.t)}else i=n.zero[0]+n.signs[0]*this.world.tcp[n.axes[0]]*n.pixelsPerM,r=n.zero[1]-n.signs[1]*this.world.tcp[n.axes[1]]*n.pixelsPerM;Math.abs(i-t.x)<.1&&Math.abs(r-t.y)<.1||(t.x=i,t.y=r,t.mark.setAttribute("transform",`translate(${i.toFixed(1)} ${r.toFixed(1)})`))}}under(e){let t=this.svg.getScreenCTM();if(!t)return null;let n=new DOMPoint(e.clientX,e.clientY).matrixTransform(t.inverse()),i=this.unit();for(let{panel:r}of this.hands){let[o,a,l,c]=r.box;if(!(r.kind!=="time"||n.x<o-i||n.x>l+i||n.y<a-i||n.y>c+i))return{panel:r,x:Math.min(l,Math.max(o,n.x)),y:n.y}}return null}time(e,t){let[n,,i]=e.box,[r,o]=this.range(e);return r+(t-n)/(i-n)*(o-r)}seen(e,t){let[n,,i]=e.box,[r,o]=this.range(e);return n+Math.min(1,Math.max(0,(t-r)/(o-r)))*(i-n)}across(e,t){let[n,,i]=e.box,r=(t-e.t[0])/(e.t[1]-e.t[0]);return n+Math.min(1,Math.max(0,r))*(i-n)}click(e){let t=this.under(e),n=this.drag?.moved??!1;this.drag=null,!(!t||n)&&(this.cursor.seek(this.time(t.panel,t.x)),this.acts.sought())}leave(){this.box.hidden||this.cursor.back(),this.held=!1,this.box.hidden=!0,this.hover&&(this.hover.style.visibility="hidden")}point(e){this.pick(e);let t=this.under(e);if(!t||!this.hover){this.leave();return}let{panel:n,x:i,y:r}=t,[,o,,a]=n.box;this.held=!1;for(let[c,h]of[["x1",i],["x2",i],["y1",o],["y2",a]])this.hover.setAttribute(c,String(h));this.hover.style.visibility="visible";let l=this.cursor.timeOf(Math.round(this.time(n,i)/this.stepS));this.write(l,this.rows(n,l),n.name,r),this.place(i,e.clientY),this.cursor.peek(l)}rows(e,t){this.read();let[,n,,i]=e.box,r={foot:i,top:n,low:e.y[0],high:e.y[1],log:e.log??!1},o=this.across(e,t);return e.series.flatMap(a=>{let l=rf(this.curve(e,a),o,a.pad??0);if(!l)return[];let c=of(r,l,{off:a.off??1,cut:a.cut});return[{panel:e,series:a,at:.5*(l[0]+l[1]),text:e.unit?`${c}\xA0${e.unit}`:c}]})}write(e,t,n,i){let r=t.length-cf;r>0&&(i!==void 0&&t.sort((l,c)=>Math.abs(l.at-i)-Math.abs(c.at-i)),t.length=cf),t.sort((l,c)=>l.at-c.at);let o=Z("p",{class:"replay-when"},Z("b",{},Zn(e,this.stepS)));n&&o.append(" ",Z("bdi",{class:"quiet"},String(n)));let a=t.map(({panel:l,series:c,text:h})=>{let u=Ae("svg",{class:"plot replay-swatch",viewBox:"0 0 14 4"},Ae("line",{x1:"0",x2:"14",y1:"2",y2:"2",stroke:String(c.colour),"stroke-width":"3","stroke-dasharray":String(c.dashes??"none")})),f=n||!l.name?String(c.name):`${l.name}: ${c.name}`;return Z("p",{},u,Z("bdi",{},f),Z("span",{},h))});a.length===0&&a.push(Z("p",{class:"quiet"},this.isJudged?"not judged here":"nothing is drawn here")),this.box.replaceChildren(o,...a),r>0&&this.box.append(Z("p",{class:"quiet"},`and ${r} more`))}place(e,t){let{box:n,figure:i,svg:r}=this;n.hidden=!1,n.style.maxWidth="";let o=i.getBoundingClientRect(),a=r.getScreenCTM();if(!a)return;let l=e*a.a+a.e-o.left-i.clientLeft,h=i.clientWidth-l-dl,u=l-dl,f=n.offsetWidth<=h||h>=u;n.style.maxWidth=`${Math.max(80,f?h:u)}px`;let d=f?l+dl:l-dl-n.offsetWidth,g=i.clientHeight,x=Math.min(g-n.offsetHeight,Math.max(0,t-o.top-.5*n.offsetHeight));n.style.left=`${d+i.scrollLeft}px`,n.style.top=`${Math.max(0,x)+i.scrollTop}px`}};function Ev(s){let e=()=>{s.shift()?.(),s.length&&t(e)},t=n=>typeof requestIdleCallback=="function"?requestIdleCallback(n):setTimeout(n,50);s.length&&t(e)}function hf(s,e,t,n,i){let r=[],o=new ul(0,e.end,n);for(let l of document.querySelectorAll("figure[data-panels]")){let c=l.querySelector("svg");if(!(l.dataset.task!==s||!c))try{r.push(new ih(l,c,e,t,n,o,i))}catch{}}let a=null;return addEventListener("beforeprint",()=>{a=o.shown,o.reset()}),addEventListener("afterprint",()=>a&&o.show(...a)),Ev(r.map(l=>()=>l.read())),document.addEventListener("keydown",l=>l.key==="Escape"&&r.forEach(c=>c.leave())),r}var Av=80,Tv=180/Math.PI,fl=class{constructor(e,t){this.replay=e;this.world=t;let n=Z("p",{class:"replay-clock"});n.append(Z("b",{"data-readout":"t"},this.t," s")," ",Z("span",{class:"quiet"},"tick ",this.tick));let i=Z("table",{"data-readout":"tcp"},Z("caption",{},`TCP in the frame ${e.lab.name}`)),r=Z("table",{"data-readout":"q"},Z("caption",{},"Joints")),o=(h,u,...f)=>{h.append(Z("tr",{},Z("th",{scope:"row",title:u},Z("bdi",{},...br(u))),...f.map(d=>Z("td",{},d))))},a=(h,u,f)=>{let d=Z("span",{[u]:String(f)});return h.push(d),d},{other:l}=e,c=(h,u)=>{if(!l)return[];let f=Z("span",{class:"replay-other"},"\u2013");return h&&this.others.push({cell:f,track:h,column:u}),[f]};if(l){let h=()=>Z("tr",{},Z("td"),Z("th",{scope:"col"},String(e.mainLabel??"A")),Z("th",{scope:"col"},String(e.ghostLabel??"B")),Z("td"));i.append(h()),r.append(h())}["x","y","z"].forEach((h,u)=>{let f=a(this.tcp,"data-axis",u);o(i,h,f,...c(l?.tcp,u),"m")}),e.joints.forEach((h,u)=>{let f=a(this.q,"data-joint",u);if(l)this.inDegrees.push(null),o(r,h.name,f,...c(l.q.find(({name:d})=>d===h.name)?.track,0),h.unit);else if(h.unit==="rad"){let d=Z("span");this.inDegrees.push(d);let g=Z("span",{class:"quiet"},d,"\xB0");o(r,h.name,f,h.unit,g)}else this.inDegrees.push(null),o(r,h.name,f,h.unit,"")}),this.element=Z("div",{class:l?"replay-readout two":"replay-readout"},n,i),e.joints.length>0&&this.element.append(Z("div",{class:"replay-joints",...e.joints.length>8?{tabindex:"0",role:"group","aria-label":"Joints"}:{}},r)),this.write()}replay;world;element;t=Z("span");tick=Z("span",{"data-readout":"tick"});tcp=[];q=[];inDegrees=[];others=[];written=0;follow(){let e=performance.now();e-this.written>=Av&&this.write(e)}write(e=performance.now()){this.written=e;let{world:t,replay:n}=this;this.t.textContent=t.t.toFixed(Math.max(2,bl(n.stepS))),this.tick.textContent=String(Math.round(t.t/n.stepS));let{tcp:i,q:r}=n.moves;for(let{cell:o,track:a,column:l}of this.others)o.textContent=Mt(Cv(a,l,t.progress),4);for(let o=0;o<3;o++)this.tcp[o].textContent=uf(i)+Mt(t.tcp[o],4);for(let o=0;o<this.q.length;o++){this.q[o].textContent=uf(r[o])+Mt(t.q[o],4);let a=this.inDegrees[o];a&&(a.textContent=Mt(Tv*t.q[o],2))}}},Rv=.001,uf=s=>s.within>Rv&&!s.isFrame?"\u2248 ":"";function Cv({values:s,width:e,count:t},n,i){let r=Math.min(t-1,Math.floor(i)),o=Math.min(t-1,r+1),a=i-r;return s[r*e+n]+a*(s[o*e+n]-s[r*e+n])}var df=["stop","breach","fell","contact","limit","saturation","other"];function ff(s){let e=(r,o)=>df.indexOf(r)-df.indexOf(o),t=[...s].sort((r,o)=>r.x-o.x||e(r.kind,o.kind)),n=[],i=[];for(let{kind:r,x:o}of t){let a=i.map(h=>o-n[h].x<12),l=i.findIndex((h,u)=>a[u]&&n[h].kind===r);if(l>=0&&o-n[i[l]].x<4)continue;let c=l>=0?l:a.indexOf(!1);if(c<0&&i.length<3&&(c=i.length),c<0){let h=i.reduce((u,f,d)=>e(n[i[u]].kind,n[f].kind)<0?d:u,0);e(r,n[i[h]].kind)<0&&(n[i[h]]={kind:r,x:o,lane:h});continue}i[c]=n.push({kind:r,x:o,lane:c})-1}return n}var Pv=250,pl=class{element=Z("div",{class:"replay-tip",role:"tooltip"});timer=0;constructor(){this.element.hidden=!0,this.element.addEventListener("pointerleave",()=>this.leave())}show(e,t){clearTimeout(this.timer),this.element.replaceChildren(...e.map(i=>Z("p",{},i))),this.element.hidden&&document.addEventListener("keydown",this.key,!0),this.element.hidden=!1;let n=(this.element.parentElement?.clientWidth??0)-this.element.offsetWidth;this.element.style.left=`${Math.max(0,Math.min(n,t-.5*this.element.offsetWidth))}px`}leave(){clearTimeout(this.timer),this.timer=window.setTimeout(()=>!this.element.matches(":hover")&&this.hide(),Pv)}hide(){clearTimeout(this.timer),this.element.hidden=!0,document.removeEventListener("keydown",this.key,!0)}key=e=>{e.key==="Escape"&&this.hide()}};var Iv=28,Lv=26,sh=6,ml=class{constructor(e,t,n){this.replay=e;this.cursor=t;this.chosen=n;let i=e.ticks[0],r=e.ticks[e.ticks.length-1];this.slider=Z("input",{type:"range",class:"replay-slider",min:String(i),max:String(Math.max(r,i+1)),step:"1","aria-label":"Moment of the run"}),this.slider.disabled=!t.moves,this.slider.addEventListener("input",()=>t.seekTick(this.slider.valueAsNumber)),this.slider.addEventListener("focus",()=>this.say()),this.element=Z("div",{class:"replay-time"}),e.events.length>0&&(this.row.append(this.marks,this.targets),this.element.append(this.row,this.tip.element),new ResizeObserver(()=>this.layout()).observe(this.row)),this.element.append(this.slider),t.on("moved",()=>this.follow()),t.on("rested",()=>this.say()),this.follow(),this.say()}replay;cursor;chosen;element;slider;row=Z("div",{class:"replay-events",role:"group","aria-label":"Events"});targets=Z("div",{class:"replay-targets"});marks=Z("div",{class:"replay-marks"});tip=new pl;width=0;share(e){let t=this.replay.ticks[0],n=this.replay.ticks[this.replay.ticks.length-1];return n>t?Math.min(1,Math.max(0,(e-t)/(n-t))):0}follow(){let e=this.cursor.tick;this.slider.valueAsNumber=e,this.slider.style.setProperty("--done",String(Math.round(1e4*this.share(e))/100)+"%")}say(){let e=this.cursor.now().slice(0,2).map(t=>t.text);this.slider.setAttribute("aria-valuetext",[Zn(this.cursor.t,this.replay.stepS),...e].join(", "))}layout(){let e=this.row.clientWidth;e===0||e===this.width||(this.width=e,this.draw(e),this.target(e))}draw(e){let t=ff(this.replay.events.map(({kind:r,tick:o})=>({kind:r,x:e*this.share(o)}))),n=Math.max(1,...t.map(({lane:r})=>r+1)),i=Math.max(Lv,n*13);this.row.style.height=`${i}px`,this.marks.replaceChildren(...t.map(({kind:r,x:o,lane:a})=>{let l=ys(r);return l.style.left=`${100*o/e}%`,l.style.top=`${.5*i+(.5*n-a-1)*13+.5}px`,l}))}target(e){let t=Math.max(1,Math.floor(e/Iv)),n=new Map;for(let o of this.replay.events){let a=Math.min(t-1,Math.floor(this.share(o.tick)*t)),l=n.get(a);l?l.push(o):n.set(a,[o])}let i=this.targets.contains(document.activeElement);this.targets.replaceChildren();for(let[o,a]of n){let l=Z("button",{type:"button",tabindex:"-1","aria-label":this.words(a).join("; ")});l.style.left=`${100*o/t}%`,l.style.width=`${100/t}%`,l.addEventListener("click",c=>this.choose(a,c)),l.addEventListener("pointerenter",()=>this.show(l,a)),l.addEventListener("focus",()=>{this.stop(l),this.show(l,a)}),l.addEventListener("pointerleave",()=>this.tip.leave()),l.addEventListener("blur",()=>this.tip.leave()),l.addEventListener("keydown",c=>this.key(c,l)),this.targets.append(l)}let r=this.targets.firstElementChild;r instanceof HTMLElement&&(this.stop(r),i&&r.focus())}stop(e){for(let t of this.targets.querySelectorAll("[tabindex='0']"))t.tabIndex=-1;e.tabIndex=0}key(e,t){let n=e.key==="ArrowRight"?t.nextElementSibling:e.key==="ArrowLeft"?t.previousElementSibling:null;e.key!=="ArrowRight"&&e.key!=="ArrowLeft"||(e.preventDefault(),e.stopPropagation(),n instanceof HTMLElement&&n.focus())}choose(e,t){let n=this.cursor.tick,i=e.find(r=>r.tick>n)??e[0];if(t.detail>0){let r=this.row.getBoundingClientRect(),o=(t.clientX-r.left)/r.width;for(let a of e)Math.abs(this.share(a.tick)-o)<Math.abs(this.share(i.tick)-o)&&(i=a)}this.chosen(i)}words(e){let t=e.slice(0,sh).map(n=>`${Zn(this.cursor.timeOf(n.tick),this.replay.stepS)}, ${Mr(n)}`);return e.length>sh&&t.push(`and ${e.length-sh} more`),t}show(e,t){this.tip.show(this.words(t),e.offsetLeft+.5*e.offsetWidth+this.row.offsetLeft)}meanings(){return[...new Set(this.replay.events.map(t=>t.kind))].map(t=>Z("li",{},ys(t),gs[t].name))}};var mr=class{constructor(e){this.replay=e;this.poses=new Float64Array(7*e.nodes.length),this.q=new Float64Array(e.joints.length),e.nodes.forEach((t,n)=>{t.pose!==null&&(this.poses.set(t.pose,7*n),xn(this.poses,7*n))}),this.at(e.ticks[0]*e.stepS)}replay;poses;lab=new Float64Array(7);tcp=new Float64Array(3);tcpInWorld=new Float64Array(3);q;t=0;progress=0;at(e){let{ticks:t,stepS:n,nodes:i,moves:r,lab:o}=this.replay,a=e/n,l=Math.abs(a-Math.round(a))<1e-6?Math.round(a):a,c=Jc(t,l),h=Math.min(c+1,t.length-1);this.t=e,this.progress=c+(h>c?Math.min(1,Math.max(0,(l-t[c])/(t[h]-t[c]))):0);for(let u=0;u<r.nodes.length;u++)r.nodes[u].at(l);for(let u=0;u<i.length;u++){let f=i[u].track;f>=0&&r.nodes[f].pose(this.poses,7*u)}r.tcp.at(l);for(let u=0;u<3;u++)this.tcp[u]=r.tcp.number(u);for(let u=0;u<this.q.length;u++)r.q[u].at(l),this.q[u]=r.q[u].number(0);this.frame(this.lab,o.node,o.pose),it(this.tcpInWorld,0,this.lab,0,this.tcp[0],this.tcp[1],this.tcp[2])}frame(e,t,n){t===null?e.set(n):Yn(e,0,this.poses,7*t,n,0),xn(e,0)}};var gl=class{constructor(e,t,n){this.root=e;this.data=t;this.address=n;this.cursor=new rl(t),this.parts={shadows:!0,frames:!1,ghost:!0,velocity:t.wanted!==null},this.world=new mr(t);let i=new mr(t),r=Rr(t,i);this.extent={...r,look:Qd(t,i,r)},this.view=this.open(),this.view.show("velocity",this.parts.velocity),this.scrubber=new ml(t,this.cursor,a=>this.goTo(a)),this.readout=new fl(t,this.world),this.controls=new ll(t,this.cursor,{event:a=>this.event(a),copyLink:()=>{this.copyLink()},view:()=>this.view,show:(a,l)=>{this.parts[a]=l,this.view.show(a,l)},shown:a=>this.parts[a],flatten:this.extent.flat&&this.view instanceof Ei?a=>this.flatten(a):null,fullScreen:document.fullscreenEnabled?()=>this.fill():null}),this.view.tooSlow=()=>this.controls.show("shadows",!1),this.note.hidden=!0,this.shared.hidden=!0;let o=t.ended?[Z("p",{class:"replay-ended"},`The run ended early: ${t.ended}`)]:[];e.append(Kd(e,this.view.element),Z("div",{class:"replay-beside"},this.readout.element,this.legend()),Z("div",{class:"replay-below"},this.note,this.scrubber.element,this.controls.element,this.shared,...o),this.announcer.element),e.setAttribute("role","group"),e.setAttribute("aria-label",`Replay: ${t.title}`),e.tabIndex=-1,jd(e),e.addEventListener("fullscreenchange",()=>this.controls.filled(document.fullscreenElement===e)),cl(e,this.cursor,a=>this.event(a)),this.plots=hf(t.task,this.cursor,this.world,t.stepS,{sought:()=>this.announcer.say(this.here()),event:a=>this.event(a),say:a=>this.announcer.say(a)}),this.cursor.on("moved",()=>this.follow()),this.cursor.on("rested",()=>this.rest()),this.cursor.on("ended",()=>this.announcer.say(`${this.here()}, the end`)),e.classList.add("on"),this.view instanceof an&&(this.lost=!0,this.sayFlat("This browser shows no WebGL"))}root;data;address;cursor;world;extent;announcer=new sl;scrubber;controls;readout;plots;note=Z("p",{class:"replay-note"});shared=Z("p",{class:"replay-shared"});parts;view;spatial=null;lost=!1;picture=null;quiet=!1;get task(){return this.data.task}open(){let e="The run in 3D. Arrow keys turn the view, with Shift they move it, plus and minus zoom.";return Ja()?new Ei(this.data,this.world,this.extent,e,()=>this.fall()):this.side()}side(){return new an(this.data,this.world,this.extent,"The run, seen from the side")}fall(){if(this.lost)return;if(this.lost=!0,this.view instanceof an){this.sayFlat("The 3D view was lost");return}let e=this.view.element,t=e.contains(document.activeElement);this.view=this.side();for(let n of["frames","ghost","velocity"])this.view.show(n,this.parts[n]);e.replaceWith(this.view.element),t&&this.view.element.focus({preventScroll:!0}),this.sayFlat("The 3D view was lost")}flatten(e){if(this.lost||e===this.view instanceof an)return;let t=this.view,n=e?this.side():this.spatial??t;e&&(this.spatial=t),this.view=n;for(let i of["shadows","frames","ghost","velocity"])n.show(i,this.parts[i]);t.element.replaceWith(n.element),n.invalidate()}sayFlat(e){this.note.textContent=`${e}, so the run is drawn flat, seen from the side.`,this.note.hidden=!1,this.controls.flat(!0)}fill(){(document.fullscreenElement===this.root?document.exitFullscreen():this.root.requestFullscreen()).catch(()=>{})}legend(){let{data:e}=this,t=[],n=(r,o)=>{t.push(Z("li",{},Z("i",{class:`replay-swatch-${r}`,"aria-hidden":"true"}),o))};e.mainLabel&&n("main",`run ${e.mainLabel}`),e.nodes.some(r=>r.kind==="ghost")&&n("ghost",dr(e)?"the reference's arm":`run ${e.ghostLabel}`),n("trail","path of the TCP, thin where it is still to come"),Li(e).length>0&&n("left","where it was farther from the path than earns all points, with an arrow to the path"),e.wanted&&(n("velocity","velocity of the TCP, as an arrow"),n("wanted","velocity that was commanded")),Pi(e,e.contacts.length).some(({force:r})=>r)&&n("force","force of the arm on what it touches, at its greatest"),e.reference&&e.reference.path.count>1&&n("reference",dr(e)?"the reference's path":`path of run ${e.ghostLabel}`),e.goals.length&&n("goal",e.goals.length>1?"goals":"goal"),e.paths.length&&n("path","path to follow, and how far off still counts");let i=Z("ul",{class:"replay-legend"},...t);for(let r of this.scrubber.meanings())i.append(r);return e.contacts.length&&!e.events.some(r=>r.kind==="contact")&&i.append(Z("li",{},ys("contact"),"contact")),i}follow(){this.world.at(this.cursor.t),this.view.invalidate(),this.cursor.playing?this.readout.follow():this.readout.write();for(let e=0;e<this.plots.length;e++)this.plots[e].follow()}rest(){if(this.readout.write(),this.shared.hidden=!0,this.quiet)return;this.address.write(this.link());let e=document.activeElement;e&&this.root.contains(e)&&!e.matches("input")&&this.announcer.soon(()=>this.here())}quietly(e){this.quiet=!0,e(),this.quiet=!1}state(){let{rest:e,speed:t,loop:n}=this.cursor;return{t:e,speed:t,loop:n,parts:{...this.parts}}}restore(e){let{t,speed:n,loop:i,parts:r}=e;this.quietly(()=>{typeof t=="number"&&this.cursor.seek(t),ol.some(o=>o===n)&&this.cursor.setSpeed(n),typeof i=="boolean"&&this.cursor.setLoop(i);for(let o of Object.keys(this.parts)){let a=r?.[o];typeof a=="boolean"&&this.controls.show(o,a)}})}link(){return Wd(this.data.task,Ml(this.cursor.t,this.data.stepS))}here(){let e=this.cursor.now().slice(0,2).map(Mr);return[Zn(this.cursor.t,this.data.stepS),...e].join(", ")}event(e){let t=this.cursor.event(e);t?this.goTo(t):this.announcer.say(e>0?"no later event":"no earlier event")}goTo(e){this.cursor.seekTick(e.tick),this.announcer.say(this.here())}visit(e,t=!1){this.cursor.pause(),e!==null&&this.cursor.seek(e),us(this.root,t),this.announcer.say(this.here())}async copyLink(){this.cursor.pause(),this.address.write(this.link()),this.address.flush();let e=Xd(location,this.link()),n=await qd(e)?"Link copied":"Copy this link";this.shared.replaceChildren(`${n}: `,Z("code",{},e)),this.shared.hidden=!1,this.announcer.say(n)}toPaper(){if(this.picture)return;let e=this.view.picture?.();e&&(this.picture=Z("img",{class:"replay-print",src:e,alt:`The run at ${this.here()}`}),this.view.element.append(this.picture))}toScreen(){this.picture?.remove(),this.picture=null}shown(){let{world:e,data:t,cursor:n}=this,i={};return t.nodes.forEach((r,o)=>{r.name in i||(i[r.name]=[...e.poses.subarray(7*o,7*o+7)])}),{t:n.t,tick:n.tick,tcp:[...e.tcp],q:[...e.q],nodes:i}}};var rn=[],gr=new tl,mf=new il,gf=!1;function Nv(s){let e=document.getElementById(s.dataset.replay??"")?.textContent;try{if(!e)throw new Error("its data is missing from this page");rn.push(new gl(s,Bd(e),gr))}catch(t){let n=t instanceof Error?t.message:"its data cannot be read";s.replaceChildren(Z("p",{class:"replay-note"},`This replay cannot be shown: ${n}.`)),s.classList.add("off")}}var yf=[];function Dv(s){let e=document.getElementById(s.dataset.arm??"")?.textContent;try{if(!e)throw new Error("its data is missing from this page");yf.push(new Ka(s,zd(e)))}catch(t){let n=t instanceof Error?t.message:"its data cannot be read";s.replaceChildren(Z("p",{class:"replay-note"},`The arm cannot be moved here: ${n}.`)),s.classList.add("off")}}function rh(s,e=!1){if(!s)return;let t=[];s.unread!==null&&t.push(`The time \u201C${s.unread}\u201D of this link cannot be read. Give the time in seconds, as in #task=${s.task}&t=2.35.`);let n=Jd(),i=Hd(s.task,[...rn.map(o=>o.task),...n.keys()]),r=rn.find(o=>o.task===i);if(r){let{end:o}=r.cursor;s.t!==null&&s.t>o+.01&&t.push(`The run of ${r.task} ends at ${Number(o.toFixed(4))} s, before the ${s.t} s of this link.`),r.visit(s.t,e)}else if(i!==void 0)s.t!==null&&t.push(`The task ${i} has no replay, so there is no ${s.t} s to show.`),us(n.get(i),e);else{let o=[...new Set([...rn.map(a=>a.task),...n.keys()])];t.push(`This page has no task \u201C${s.task}\u201D, which the link names. It has: ${o.join(", ")}.`)}t.length>0?mf.say(t.join(" ")):mf.clear()}for(let s of document.querySelectorAll("[data-replay]"))Nv(s);for(let s of document.querySelectorAll("[data-arm]"))Dv(s);for(let s of rn)s.cursor.on("changed",()=>{if(s.cursor.playing)for(let e of rn)e!==s&&e.cursor.pause()});addEventListener("hashchange",()=>{if(gr.forget(),location.hash!=="")rh(nl(location.hash));else for(let s of rn)s.quietly(()=>s.cursor.seek(s.cursor.start))});document.addEventListener("click",s=>{let e=s.target instanceof Element?s.target.closest("a.seek"):null;if(!(e instanceof HTMLAnchorElement)||s.button!==0||s.ctrlKey||s.metaKey||s.shiftKey||s.altKey)return;let t=nl(e.hash);if(t){if(s.preventDefault(),gr.flush(),location.hash!==e.hash)try{history.pushState(null,"",e.hash)}catch{}rh(t)}});addEventListener("beforeprint",()=>rn.forEach(s=>s.toPaper()));addEventListener("afterprint",()=>rn.forEach(s=>s.toScreen()));addEventListener("pagehide",()=>gr.flush());requestAnimationFrame(()=>gf||rh(nl(location.hash),!0));Object.assign(window,{kinemark:{replays:rn.map(s=>({task:s.task,shown:()=>s.shown(),seek:e=>s.cursor.seek(e),frameTimes:()=>s.cursor.frameTimes.list()})),arms:yf.map(s=>({shown:()=>s.shown(),put:e=>s.put(e)})),state:()=>(gr.flush(),Object.fromEntries(rn.map(s=>[s.task,s.state()]))),restore:s=>{gf=!0;for(let e of rn)Object.hasOwn(s,e.task)&&e.restore(s[e.task])}}});})();